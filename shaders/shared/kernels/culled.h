// Whether the eye looks through this side of a surface, as rasterisers do, which show only the
// front of one-sided surfaces. The back of a solid is its inside.
FN bool is_culled(IN(MaterialRecord) m, bool front) {
    return may_have(m, MATERIAL_ALPHA) && scene[0].cull_back_faces != 0u && !front &&
           m.double_sided == 0u && !is_solid(m);
}
