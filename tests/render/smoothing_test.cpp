#include <algorithm>

#include "render/renderer_fixture.h"

namespace gelatin::render {
namespace {

class SmoothingTest : public RendererTest {};

TEST_F(SmoothingTest, EverySmoothingGivesTheSamePicture) {
    Studio studio;
    studio.options.smoothing = Smoothing::none;
    const Image rough = picture_of(studio);
    for (const Smoothing smoothing : {Smoothing::samples, Smoothing::filter}) {
        studio.options.smoothing = smoothing;
        const Image smooth = picture_of(studio);
        EXPECT_LT(test::perceptual_difference(smooth, rough), 1.5);
        EXPECT_NE(smooth.pixels, rough.pixels);
    }
}

// Along the outline a smooth picture has colours between the body's and the floor's; a rough one has none.
TEST_F(SmoothingTest, SmoothingBlendsEdges) {
    const auto blended = [](Smoothing smoothing) {
        Studio studio;
        studio.options.smoothing = smoothing;
        const Image image = picture_of(studio);
        int count = 0;
        for (int y = 30; y < 90; ++y) {
            for (int x = 40; x < kWidth / 2; ++x) {
                // The ball is deep red, the floor light grey: saturation shows how much of each is in a
                // pixel.
                const auto* p = image.at(x, y);
                const double saturation =
                    1.0 - static_cast<double>(std::min(p[1], p[2])) / std::max<int>(p[0], 1);
                count += saturation > 0.12 && saturation < 0.45;
            }
        }
        return count;
    };
    const int rough = blended(Smoothing::none);
    EXPECT_GT(blended(Smoothing::samples), rough + 10);
    EXPECT_GT(blended(Smoothing::filter), rough + 10);
}

}  // namespace
}  // namespace gelatin::render
