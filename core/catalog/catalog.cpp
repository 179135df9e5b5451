#include "core/catalog/catalog.h"

#include "core/brute_force/brute_force.h"
#include "core/bsp/bsp_build.h"
#include "core/bvh/binned_sah.h"
#include "core/bvh/late_split_clipping.h"
#include "core/bvh/morton.h"
#include "core/bvh/object_median.h"
#include "core/bvh/optimize.h"
#include "core/bvh/ploc.h"
#include "core/bvh/refit.h"
#include "core/bvh/spatial_median.h"
#include "core/bvh/spatial_splits.h"
#include "core/bvh/sweep_sah.h"
#include "core/grid/uniform_grid.h"
#include "core/kdtree/kd_median.h"
#include "core/kdtree/kd_sah.h"
#include "core/kdtree/ropes.h"
#include "core/octree/octree.h"
#include "core/octree/quadtree.h"
#include "core/refs/early_split_clipping.h"
#include "core/refs/edge_volume.h"
#include "core/refs/refine.h"
#include "core/refs/whole_boxes.h"
#include "core/volume_bvh/bounding_volumes.h"
#include "core/wide_bvh/collapse.h"
#include "core/wide_bvh/qualities.h"

namespace boxwood {
namespace {

constexpr CatalogEntry kReferences[] = {
    row<WholeBoxes>("whole", "one box for each triangle", "Kerbl, lecture, \"Bounding volumes\""),
    row<Refinement>("refine", "geometry refinement", "Ernst and Greiner 2007, section 4"),
    row<EdgeVolume>("evh", "edge volume heuristic", "Dammertz and Keller 2008, section 2"),
    row<EarlySplitClipping>("esc", "early split clipping", "Ernst and Greiner 2007, algorithm 4"),
};

constexpr CatalogEntry kBuilders[] = {
    row<BruteForceBuilder>("none", "brute force", "Kerbl, lecture, \"Structure: none\""),
    row<UniformGrid>("grid", "regular grid", "Kerbl, lecture, \"Regular Grid\"; Amanatides and Woo 1987"),
    row<Octree>("octree", "octree", "Kerbl, lecture, \"Quad and Octrees\""),
    row<Quadtree>("quadtree", "quadtree over the ground plane", "Kerbl, lecture, \"Quad and Octrees\""),
    row<SpatialMedian>("bvh-spatial-median", "BVH, spatial median",
                       "Kay and Kajiya 1986; Ernst and Greiner 2007, 3.2"),
    row<ObjectMedian>("bvh-object-median", "BVH, object median",
                      "Kerbl, lecture, \"Splitting at object median\""),
    row<BinnedSah>("bvh-binned-sah", "BVH, binned SAH", "Wald 2007, section 3"),
    row<SweepSah>("bvh-sweep-sah", "BVH, SAH sweep", "Wald, Boulos and Shirley 2007, section 4"),
    row<SpatialSplits>("bvh-spatial-splits", "BVH, spatial splits", "Stich, Friedrich and Dietrich 2009"),
    row<Morton>("bvh-morton", "BVH, Morton order", "Lauterbach et al. 2009, section 3"),
    row<Ploc>("bvh-ploc", "BVH, locally-ordered clustering", "Meister and Bittner 2018, section 3"),
    row<Preview>("preview", "16-wide BVH, built fastest",
                 "Lauterbach et al. 2009; Wald, Benthin and Boulos 2008"),
    row<Balanced>("balanced", "16-wide BVH, built fast for speed",
                  "Wald 2007; Ylitie, Karras and Laine 2017"),
    row<Best>("best", "16-wide BVH, traced fastest",
              "Stich et al. 2009; Meister and Bittner 2018; Ylitie et al. 2017"),
    row<BspSah>("bsp", "BSP, planes of triangles and axes",
                "Fuchs, Kedem and Naylor 1980; Ize, Wald and Parker 2008; Kerbl, lecture"),
    row<KdMedian>("kd-median", "kd-tree, median", "Bentley 1975; Kaplan 1985; Kerbl, lecture, \"k-d tree\""),
    row<KdSah>("kd-sah", "kd-tree, SAH by sorted events",
               "Wald and Havran 2006, 4.3; Ernst and Greiner 2007, algorithm 3"),
};

constexpr CatalogEntry kTransforms[] = {
    row<AddRopes>("ropes", "kd-tree with ropes, stackless",
                  "Popov, Guenther, Seidel and Slusallek 2007, section 3"),
    row<LateSplitClipping>("lsc", "late split clipping", "Ernst and Greiner 2007, 5.1"),
    row<Optimize>("optimize", "parallel reinsertion", "Meister and Bittner 2018"),
    row<Spheres>("spheres", "bounding spheres", "Kerbl, lecture, \"Bounding volumes\""),
    row<OrientedBoxes>("oriented-boxes", "oriented boxes",
                       "Kerbl, lecture, \"Bounding volumes\"; Gottschalk et al. 1996"),
    row<Collapse<4>>("wide4", "BVH with four children",
                     "Dammertz, Hanika and Keller 2008; Ylitie, Karras and Laine 2017, 3.1"),
    row<Collapse<8>>("wide8", "BVH with eight children",
                     "Wald, Benthin and Boulos 2008; Ylitie, Karras and Laine 2017, 3.1"),
    row<Collapse<16>>("wide16", "BVH with sixteen children",
                      "Wald, Benthin and Boulos 2008; Ylitie, Karras and Laine 2017, 3.1"),
    row<Refit>("refit", "refit to another frame", "Wald, Boulos and Shirley 2007, ACM TOG 26(1)"),
};

}  // namespace

const CatalogEntry* Catalog::find(const std::string& id) const {
    for (const std::span<const CatalogEntry> table : {references, builders, transforms})
        for (const CatalogEntry& entry : table)
            if (id == entry.id) return &entry;
    return nullptr;
}

std::vector<std::string> Catalog::ids() const {
    std::vector<std::string> ids;
    for (const std::span<const CatalogEntry> table : {references, builders, transforms})
        for (const CatalogEntry& entry : table) ids.push_back(entry.id);
    return ids;
}

const Catalog& catalog() {
    static const Catalog catalog{kReferences, kBuilders, kTransforms};
    return catalog;
}

std::span<const CatalogEntry> reference_catalog() { return kReferences; }
std::span<const CatalogEntry> builder_catalog() { return kBuilders; }
std::span<const CatalogEntry> transform_catalog() { return kTransforms; }

const CatalogEntry* find_entry(const std::string& id) { return catalog().find(id); }

}  // namespace boxwood
