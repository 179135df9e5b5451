#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "app/gl/gl_messages.h"

namespace boxwood {

/// An OpenGL 4.5 core context in memory, without a display; current in the thread that made it. Everything
/// is drawn into a RenderTarget: the context's own image is never shown.
class OsmesaContext {
public:
    /// Throws Error (NoDisplay).
    OsmesaContext();
    ~OsmesaContext();
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    const GlMessages& messages() const { return *messages_; }

private:
    static constexpr int kSize = 16;  ///< of the image that OSMesa asks for
    void* context_ = nullptr;
    std::array<uint8_t, 4 * kSize * kSize> image_{};
    std::unique_ptr<GlMessages> messages_;
};

}  // namespace boxwood
