// A material as the kernel needs it, which is specialised to what the scene's materials have.
FN MaterialRecord load_material(uint index) {
    MaterialRecord m = materials[index];
    m.absent = ~material_features;
    return m;
}
