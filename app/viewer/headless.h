#pragma once

#include "app/gl/context_osmesa.h"
#include "app/viewer/frame.h"

namespace boxwood {

/// The viewer without a window: a context in memory and the frame drawn into it.
class Headless {
public:
    /// The picture of a session, once its work is done. Throws Error where scene or recipe are refused, and
    /// std::logic_error where OpenGL reports an error of ours.
    Image capture(const Session& session);

    Frame& frame() { return frame_; }
    const GlMessages& messages() const { return context_.messages(); }

private:
    OsmesaContext context_;
    Frame frame_;
};

}  // namespace boxwood
