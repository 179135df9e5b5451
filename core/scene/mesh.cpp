#include "core/scene/mesh.h"

namespace boxwood {

Box Mesh::bounds() const {
    Box box;
    for (uint32_t prim = 0; prim < triangles.size(); ++prim) box.extend(triangle(prim).bounds());
    return box;
}

size_t Mesh::byte_count() const {
    size_t bytes = positions.size() * sizeof(Vec3) + triangles.size() * sizeof(UVec3) +
                   (source_prim.size() + object.size()) * sizeof(uint32_t) +
                   (points.positions.size() + points.normals.size()) * sizeof(Vec3);
    for (const MeshObject& o : objects) bytes += sizeof(MeshObject) + o.name.size();
    return bytes;
}

}  // namespace boxwood
