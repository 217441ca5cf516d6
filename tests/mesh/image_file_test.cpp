#include "mesh/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/mesh_samples.h"
#include "mesh/texture_samples.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ImageFile, PngBeginsWithItsLowestRow) {
    const TextureImage image = decode_image(png_sample());
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 2);
    EXPECT_THAT(image.pixels, ElementsAre(0, 0, 255, 255, 255, 255, 255, 255,  //
                                          255, 0, 0, 255, 0, 255, 0, 255));
}

TEST(ImageFile, JpegIsNearlyWhatItWas) {
    const TextureImage image = decode_image(jpeg_sample());
    ASSERT_EQ(image.width, 8);
    ASSERT_EQ(image.height, 8);
    const int low[] = {20, 60, 220}, high[] = {200, 30, 40};
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(image.pixels[k], low[k], 12);
        EXPECT_NEAR(image.pixels[4 * 63 + k], high[k], 12);
    }
}

TEST(ImageFile, RefusesWhatIsNoPicture) {
    for (const std::string& file : {std::string(), std::string("GIF89a"), std::string("v 0 0 0\n")})
        EXPECT_THAT(refusal([&] { check_image(file); }), HasSubstr("is neither a PNG nor a JPEG file"));
}

// Every beginning is refused, or is a picture of the same size.
TEST(ImageFile, RefusesDamagedFiles) {
    for (const std::string& whole : {png_sample(), jpeg_sample()}) {
        std::size_t refused = 0;
        for (std::size_t size = 0; size < whole.size(); ++size) {
            try {
                decode_image(whole.substr(0, size));
            } catch (const InvalidInput&) {
                ++refused;
            }
        }
        EXPECT_GT(refused, whole.size() / 2);
    }
}

TEST(ImageFile, RefusesPicturesThatOpenGlNeedNotTake) {
    std::string huge = png_sample();
    huge[18] = '\x50';  // the width: 2 + 0x5000
    EXPECT_THAT(refusal([&] { check_image(huge); }), HasSubstr("has 20482 x 2 pixels"));
}

}  // namespace
}  // namespace gelatin
