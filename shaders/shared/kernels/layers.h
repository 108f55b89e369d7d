// Adds radiance to a layer of a path. Needs a buffer `layers`.
FN void add_to_layer(uint slot, uint layer, vec3 radiance) {
    if (layer == layer_direct) {
        layers[slot].direct_r += radiance.x;
        layers[slot].direct_g += radiance.y;
        layers[slot].direct_b += radiance.z;
    } else if (layer == layer_indirect) {
        layers[slot].indirect_r += radiance.x;
        layers[slot].indirect_g += radiance.y;
        layers[slot].indirect_b += radiance.z;
    } else {
        layers[slot].caustic_r += radiance.x;
        layers[slot].caustic_g += radiance.y;
        layers[slot].caustic_b += radiance.z;
    }
}
