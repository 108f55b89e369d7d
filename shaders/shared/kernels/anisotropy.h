// Anisotropic materials at a hit. Include normals.h before.

// Turns a material's anisotropy from the frame of the tangents into the shading frame.
FN void turn_anisotropy(HitRecord hit, IN(Surface) s, IN(Frame) frame, INOUT(MaterialRecord) m) {
    vec2 v = anisotropy(m);
    if (!is_anisotropic(m.absent, v)) {
        return;
    }
    vec3 normal = s.front ? s.shading_normal : -s.shading_normal;
    vec3 along = to_local(frame, along_tangents(hit, normal, vec3(v.x, v.y, real(0.0))));
    vec2 unit = unit_direction(vec2(along.x, along.y));
    real strength = sqrt(v.x * v.x + v.y * v.y);
    m.anisotropy_x = float32(unit.x * strength);
    m.anisotropy_y = float32(unit.y * strength);
}
