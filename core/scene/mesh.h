#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/array.h"
#include "core/base/box.h"
#include "core/base/vec.h"

namespace boxwood {

/// Points of a point cloud; exact structures ignore them and say so. Arrays of equal length (normals may be
/// empty).
struct PointCloud {
    Array<Vec3> positions;
    std::vector<Vec3> normals;
};

/// Corners of one triangle.
struct Triangle {
    Vec3 a, b, c;

    Box bounds() const {
        Box box;
        box.extend(a);
        box.extend(b);
        box.extend(c);
        return box;
    }
};

/// One mesh instance of the file: what a row of the scene panel names.
struct MeshObject {
    std::string name;       ///< valid UTF-8
    Vec3 base_color{0.8f};  ///< linear RGB in [0, 1]
};

/// What is to be rendered: flat arrays, instances flattened. Triangles with a non-finite vertex or exactly
/// zero area are absent, as check_mesh leaves it. Triangle i has the arrays' entry i:
struct Mesh {
    Array<Vec3> positions;
    Array<UVec3> triangles;             ///< three indices into positions
    std::vector<uint32_t> source_prim;  ///< the triangle's number in the file, increasing
    std::vector<uint32_t> object;       ///< index into objects
    std::vector<MeshObject> objects;
    PointCloud points;

    size_t triangle_count() const { return triangles.size(); }
    Triangle triangle(uint32_t prim) const {
        const UVec3 t = triangles[prim];
        return {positions[t.x], positions[t.y], positions[t.z]};
    }
    const Vec3& base_color(uint32_t prim) const { return objects[object[prim]].base_color; }
    /// Box of all triangles; empty for none.
    Box bounds() const;
    size_t byte_count() const;
};

}  // namespace boxwood
