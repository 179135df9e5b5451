#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/viewer/state.h"

namespace boxwood {

/// What `check` forgives between a session's picture and the same session rendered again.
struct CheckLimits {
    int difference = 3;      ///< a pixel beyond this, of 255 in any channel, counts
    int pixels = 0;          ///< pixels that may be beyond it
    double tile_mean = 3.0;  ///< largest mean difference over a tile of 16 x 16 pixels, of 255

    bool operator==(const CheckLimits&) const = default;
};

/// A session file in memory.
struct Session {
    ViewerState state;  ///< state.scene: a built-in, or a file relative to the current folder
    CheckLimits limits;
    std::string unknown = "{}";      ///< keys that this version does not know, as a JSON object: kept
    std::vector<std::string> notes;  ///< a sentence for each unknown key
};

inline constexpr size_t kMostSessionBytes = size_t{16} << 20;

/// Whether the text is a session, and no other JSON such as a glTF file.
bool is_session_text(const std::string& text);

/// Reads a session, JSON of version 1. A scene file in it is relative to `folder`. `where` names the text in
/// messages: a file, or "clipboard". Throws Error (BadInput) with where, the line or key, and what was
/// expected: for other versions, wrong types, values out of range, absolute scene files, nesting beyond 32
/// levels, more than 16 MiB.
Session parse_session(const std::string& text, const std::string& folder, const std::string& where);

/// The session as JSON with a newline at its end; what equals its default is left out, unknown keys stand at
/// the end. A scene file is named relative to `folder`.
std::string print_session(const Session& session, const std::string& folder);

/// Reads a session file, or the session in a PNG's text chunk; nothing if the file is another format, which
/// makes it a scene. Throws Error (BadInput) where the file or the session cannot be read.
std::optional<Session> load_session(const std::string& path);

/// Throws Error (WrongUsage) where the file cannot be written; see write_file_atomically.
void save_session(const Session& session, const std::string& path);

/// The folder part of a path: "." if there is none.
std::string session_folder(const std::string& path);

}  // namespace boxwood
