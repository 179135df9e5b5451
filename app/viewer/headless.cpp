#include "app/viewer/headless.h"

#include <stdexcept>

namespace boxwood {

Image Headless::capture(const Session& session) {
    Viewer viewer(session);
    Image image = frame_.capture(viewer);
    if (messages().error_count > 0) throw std::logic_error("OpenGL: " + messages().first_error);
    return image;
}

}  // namespace boxwood
