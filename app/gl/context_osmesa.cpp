#include "app/gl/context_osmesa.h"

#include <GL/osmesa.h>

#include "core/base/error.h"

namespace boxwood {

OsmesaContext::OsmesaContext() : messages_(std::make_unique<GlMessages>()) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    OSMesaContext context = OSMesaCreateContextAttribs(attributes, nullptr);
    if (context == nullptr) {
        throw Error(ExitCode::NoDisplay, "OSMesa offers no OpenGL 4.5 core context in memory");
    }
    context_ = context;
    try {
        if (OSMesaMakeCurrent(context, image_.data(), GL_UNSIGNED_BYTE, kSize, kSize) == GL_FALSE) {
            throw Error(ExitCode::NoDisplay, "OSMesa cannot make its OpenGL context current");
        }
        start_gl(OSMesaGetProcAddress, *messages_);
    } catch (...) {
        OSMesaDestroyContext(context);
        throw;
    }
}

OsmesaContext::~OsmesaContext() { OSMesaDestroyContext(static_cast<OSMesaContext>(context_)); }

}  // namespace boxwood
