#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Rays of a file; ids[i] names rays[i].
struct RayFile {
    std::vector<std::string> ids;
    std::vector<Ray> rays;
};

/// Reads `id ox oy oz dx dy dz tmin tmax` a line: the id is any word, the numbers are decimal or C99 hex
/// floats, inf and nan included (a ray whose origin or direction is not finite misses). Blank lines and lines
/// that begin with # are passed over. Throws Error (BadInput) with `name`, the line, and what was expected;
/// also for tmin below 0 and for numbers that no float holds.
RayFile parse_rays(std::string_view text, const std::string& name);

/// Reads 8 little-endian float32 a ray: ox oy oz dx dy dz tmin tmax; the ids are 0, 1, ... Errors as above,
/// with the ray's number.
RayFile parse_binary_rays(std::string_view bytes, const std::string& name);

/// One line as parse_rays reads it, in hex floats, so that no bit is lost; without a line end.
std::string ray_line(const std::string& id, const Ray& ray);

/// `id prim t` a line: prim as counted in the scene's file, -1 for a miss; t in the shortest decimal form
/// that reads back as the same float, inf for a miss. hits.size() == file.ids.size().
std::string hit_lines(const RayFile& file, std::span<const Hit> hits, const Mesh& mesh);

}  // namespace boxwood
