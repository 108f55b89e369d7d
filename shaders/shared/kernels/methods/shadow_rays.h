// For a slot without a ray.
FN RayRecord no_ray() {
    return RayRecord(real(0.0), real(0.0), real(0.0), -real(1.0), real(0.0), real(0.0), real(1.0),
                     0u);
}
