// Whether rays go on behind a surface: glass, and what is partly there. Where a mask takes a
// surface away, rays do not hit it in the first place.
FN bool passes_light(IN(MaterialRecord) material) {
    bool passes = (bsdf_lobes(material) & (LOBE_TRANSMIT | LOBE_CLEAR)) != 0u;
    if (may_have(material, MATERIAL_ALPHA) && (material.textures & material_alpha_mask) == 0u) {
        passes = passes || material.coverage < float32(1.0) ||
                 (material.textures & material_alpha_blend) != 0u;
    }
    return passes;
}
