#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace boxwood {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec3 = glm::dvec3;
using UVec3 = glm::uvec3;

inline bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_finite(const DVec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// "No index": the parent of the root, the primitive of a miss.
inline constexpr uint32_t kNoIndex = 0xffffffffu;

}  // namespace boxwood
