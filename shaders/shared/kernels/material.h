// Loads a material for a kernel that is specialised to the features of the scene's materials.
FN MaterialRecord load_material(uint index) {
    MaterialRecord m = materials[index];
    m.absent = ~material_features;
    return m;
}
