#include "app/gl/read_pixels.h"

#include <algorithm>

namespace boxwood {

Image read_pixels(const RenderTarget& target) {
    Image image(target.width(), target.height());
    const auto row_bytes = 4 * static_cast<size_t>(target.width());
    std::vector<uint8_t> upwards(image.rgba.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.image_framebuffer());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, target.width(), target.height(), GL_RGBA, GL_UNSIGNED_BYTE, upwards.data());
    for (int y = 0; y < target.height(); ++y) {
        const uint8_t* from = upwards.data() + static_cast<size_t>(target.height() - 1 - y) * row_bytes;
        std::copy_n(from, row_bytes, image.pixel(0, y));
    }
    for (size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    return image;
}

}  // namespace boxwood
