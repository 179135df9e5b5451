#include "core/wide_bvh/qualities.h"

#include <algorithm>
#include <memory>
#include <mutex>

#include "core/base/assert.h"
#include "core/bvh/binned_sah.h"
#include "core/bvh/morton.h"
#include "core/bvh/optimize.h"
#include "core/bvh/spatial_splits.h"
#include "core/wide_bvh/binned_part.h"
#include "core/wide_bvh/collapse.h"
#include "core/wide_bvh/morton_part.h"
#include "core/wide_bvh/part_top.h"
#include "core/wide_bvh/sampled_cost.h"

namespace boxwood {

namespace {

constexpr uint32_t kBinnedPartSize = 4096;  ///< triangles of a part of `balanced`, at most
/// From here on `best` splits space. Scans have 2.2 to 3.4, and spatial splits lower their cost by at most 2
/// % (bench/RESULTS.md); architecture and machines have more, up to 18, and gain up to a sixth.
constexpr double kLooseBoxes = 4.0;
constexpr size_t kViewers = 2048;  ///< whose rays tell `best` whether pieces or whole triangles are cheaper
/// Whole triangles are taken where they cost less than this times the pieces: the rays of a view differ from
/// those of the viewers by a few percent.
constexpr double kClearlyLess = 0.95;
constexpr size_t kPartsAtOnce = 8;  ///< that a thread takes with the same memory

WideCosts collapse_costs() {
    const Collapse<16> collapse;
    return {static_cast<double>(collapse.node_cost), static_cast<double>(collapse.pack_cost)};
}

PartCosts part_costs() {
    const WideCosts costs = collapse_costs();
    return {costs.node, costs.pack, static_cast<uint32_t>(Collapse<16>{}.leaf_size) / Pack8::kSize};
}

/// Whether each reference is a triangle, and each triangle of the mesh a reference, in the same order: where
/// they are as many, as every triangle has one at least.
bool are_whole(const Mesh& mesh, std::span<const PrimRef> refs) {
    return refs.size() == mesh.triangle_count();
}

std::vector<TopNode> parts_of(std::span<const TopNode> top) {
    std::vector<TopNode> parts;
    for (const TopNode& node : top)
        if (node.is_part()) parts.push_back(node);
    return parts;
}

/// Calls make_worker() for a thread's memory and worker(part) with it for each part.
template <class MakeWorker>
void for_parts(size_t count, const Task& task, const MakeWorker& make_worker) {
    using Worker = decltype(make_worker());
    std::mutex mutex;
    std::vector<std::unique_ptr<Worker>> idle;
    const auto take = [&] {
        const std::scoped_lock lock(mutex);
        std::unique_ptr<Worker> worker;
        if (!idle.empty()) {
            worker = std::move(idle.back());
            idle.pop_back();
        }
        return worker;
    };
    parallel_for(count, kPartsAtOnce, [&](size_t begin, size_t end) {
        std::unique_ptr<Worker> worker = take();
        if (!worker) worker = std::make_unique<Worker>(make_worker());
        for (size_t i = begin; i < end && !task.stopped(); ++i) (*worker)(i);
        const std::scoped_lock lock(mutex);
        idle.push_back(std::move(worker));
    });
}

WideBvh<16> build_preview(const Mesh& mesh, std::span<const PrimRef> refs, const Task& task) {
    const MortonOrder order = morton_order(refs, Pack8::kSize, task);
    if (task.stopped()) return {};
    const std::vector<TopNode> top = divide_morton(order, kMortonPartSize), parts = parts_of(top);
    std::vector<std::vector<uint32_t>> firsts(parts.size());
    parallel_for(parts.size(), kPartsAtOnce, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) firsts[i] = morton_packs(order, parts[i].range);
    });
    // Depth first, which is the order of the curve; the parts themselves stand level by level.
    std::vector<size_t> along(parts.size());
    for (size_t i = 0; i < along.size(); ++i) along[i] = i;
    std::ranges::sort(along, {}, [&](size_t i) { return parts[i].range.begin; });
    std::vector<uint32_t> first_packs(parts.size());
    uint32_t pack_count = 0;
    for (const size_t i : along) {
        first_packs[i] = pack_count;
        pack_count += static_cast<uint32_t>(firsts[i].size()) - 1;
    }
    Array<Pack8> packs(pack_count);
    const PackFiller filler(mesh);
    std::vector<WidePiece> pieces(parts.size());
    PieceNodes memory(pack_count);
    for_parts(parts.size(), task, [&] {
        return [&, tree = PartTree(part_costs(), kMortonPartSize), writer = PieceWriter(memory),
                build = std::make_unique<MortonPartBuild>()](size_t i) mutable {
            const auto count = static_cast<uint32_t>(firsts[i].size()) - 1;
            const PartRoot root = build->build(order, firsts[i], parts[i].depth, filler,
                                               std::span(packs).subspan(first_packs[i], count), tree);
            pieces[i] = writer.write(tree, root, count);
        };
    });
    if (task.stopped()) return {};
    JoinedPieces joined = join_pieces(top_of_nodes(top, pieces, part_costs()), pieces);
    BOXWOOD_ASSERT(joined.first_packs == first_packs);
    joined.bvh.packs = std::move(packs);
    return std::move(joined.bvh);
}

WideBvh<16> build_balanced(const Mesh& mesh, std::span<const PrimRef> refs, const Task& task) {
    const MortonOrder order = morton_order(refs, Pack8::kSize, task);
    if (task.stopped()) return {};
    const std::vector<TopNode> parts = parts_of(divide_morton(order, kBinnedPartSize));
    std::vector<WidePiece> pieces(parts.size());
    Array<PackPrims> prims(refs.size());  // of each part where its references begin
    PieceNodes memory(refs.size());
    for_parts(parts.size(), task, [&] {
        return [&, tree = PartTree(part_costs(), kBinnedPartSize), writer = PieceWriter(memory),
                build = std::make_unique<BinnedPartBuild>()](size_t i) mutable {
            const PartRoot root = build->build(refs, order, parts[i].range, kMostTopDepth, tree);
            std::ranges::copy(build->packs(), &prims[parts[i].range.begin]);
            pieces[i] = writer.write(tree, root, static_cast<uint32_t>(build->packs().size()));
        };
    });
    if (task.stopped()) return {};
    JoinedPieces joined = join_pieces(top_by_cost(pieces, part_costs()), pieces);
    Array<Pack8>& packs = joined.bvh.packs;
    packs.resize(joined.pack_count);
    parallel_for(parts.size(), kPartsAtOnce, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            fill_packs(mesh, std::span(prims).subspan(parts[i].range.begin, pieces[i].pack_count),
                       std::span(packs).subspan(joined.first_packs[i], pieces[i].pack_count));
    });
    return std::move(joined.bvh);
}

/// Boxes of triangles that a random line meets in vain, as far as cuts can do something about it: the half
/// areas of the boxes less those of the triangles' projections along the axes, which the boxes of ever
/// smaller pieces tend to (Karras, Aila, "Fast Parallel Construction of High-Quality Bounding Volume
/// Hierarchies", HPG 2013, section 4: A_aabb - A_ideal), divided by that of the scene's box. 0 where that has
/// no area.
double loose_boxes(const Mesh& mesh, std::span<const PrimRef> refs, const Task& task) {
    constexpr size_t kGrain = 1 << 14;
    struct Sum {
        double excess = 0.0;
        Box box;
    };
    std::vector<Sum> sums((refs.size() + kGrain - 1) / kGrain);
    parallel_for(refs.size(), kGrain, [&](size_t begin, size_t end) {
        if (task.stopped()) return;
        Sum& sum = sums[begin / kGrain];
        for (size_t i = begin; i < end; ++i) {
            const Triangle triangle = mesh.triangle(refs[i].prim);
            const DVec3 a(triangle.a), b(triangle.b), c(triangle.c);
            const DVec3 projections = 0.5 * glm::abs(glm::cross(b - a, c - a));
            const double tight = projections.x + projections.y + projections.z;
            sum.excess += std::max(refs[i].bounds.half_area() - tight, 0.0);
            sum.box.extend(refs[i].bounds);
        }
    });
    Sum all;
    for (const Sum& sum : sums) {
        all.excess += sum.excess;
        all.box.extend(sum.box);
    }
    const double area = all.box.half_area();
    return area > 0.0 ? all.excess / area : 0.0;
}

}  // namespace

WideBvh<16> Preview::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    if (refs.empty()) return {};
    if (are_whole(mesh, refs)) return build_preview(mesh, refs, task);
    return Collapse<16>{}.apply(mesh, refs, Morton{}.build(mesh, refs, task), task);
}

WideBvh<16> Balanced::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    if (refs.empty()) return {};
    if (are_whole(mesh, refs)) return build_balanced(mesh, refs, task);
    return Collapse<16>{}.apply(mesh, refs, BinnedSah{}.build(mesh, refs, task), task);
}

WideBvh<16> Best::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    const auto finish = [&](const Bvh2& bvh) {
        const Bvh2 optimized = task.stopped() ? Bvh2{} : Optimize{}.apply(mesh, refs, bvh, task);
        return task.stopped() ? WideBvh<16>{} : Collapse<16>{}.apply(mesh, refs, optimized, task);
    };
    WideBvh<16> whole = finish(BinnedSah{}.build(mesh, refs, task));
    if (refs.empty() || task.stopped()) return whole;
    if (loose_boxes(mesh, refs, task) < kLooseBoxes) {
        task.skipped.add("tight boxes, not split in space", refs.size());
        return whole;
    }
    SpatialSplits splits;
    splits.budget = budget;
    WideBvh<16> cut = finish(splits.build(mesh, refs, task));
    const std::vector<Ray> rays = viewer_rays(mesh, whole, kViewers, task);
    const auto cost_of = [&](const WideBvh<16>& bvh) {
        return sampled_cost(bvh, mesh, rays, collapse_costs(), task);
    };
    if (kClearlyLess * cost_of(cut) < cost_of(whole)) return cut;
    task.skipped.add("cheaper whole than split", refs.size());
    return whole;
}

}  // namespace boxwood
