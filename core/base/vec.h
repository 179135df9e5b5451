#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace boxwood {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec3 = glm::dvec3;
using UVec3 = glm::uvec3;

/// "No index": the parent of the root, the primitive of a miss.
inline constexpr uint32_t kNoIndex = 0xffffffffu;

}  // namespace boxwood
