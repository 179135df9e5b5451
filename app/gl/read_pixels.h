#pragma once

#include "app/gl/render_target.h"
#include "core/render/image.h"

namespace boxwood {

/// The target's image, row 0 on top, opaque.
Image read_pixels(const RenderTarget& target);

}  // namespace boxwood
