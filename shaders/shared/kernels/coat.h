// Coats with a normal of their own. Include normals.h before.

// Turns the coat's normal from the frame of the tangents into the shading frame. Textures that turn
// the surface's normal do not turn the coat's (KHR_materials_clearcoat).
FN void turn_coat(HitRecord hit, IN(Surface) s, IN(Frame) frame, INOUT(MaterialRecord) m) {
    vec3 slope = coat_normal(m);
    if (!has_coat_normal(m.absent, slope)) {
        return;
    }
    vec3 local = to_local(frame, normal_of_slope(hit, s, slope));
    local = normal_above(local, vec3(real(0.0), real(0.0), real(1.0)));
    m.coat_normal_x = float32(local.x);
    m.coat_normal_y = float32(local.y);
    m.coat_normal_z = float32(local.z);
}
