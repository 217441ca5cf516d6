#include "model/drive/attachment.h"

#include "model/model.h"

namespace gelatin {

bool joins(const Model& model, std::uint32_t object, std::uint32_t other) {
    if (model.is_body(other)) return model.objects[object].is_rigid && model.objects[other].is_rigid;
    return model.objects[object].is_rigid || model.surfaces[other - model.body_count()].deforms;
}

}  // namespace gelatin
