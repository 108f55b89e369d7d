// What a texel of a candidate's map shows.
struct CubePlace {
    uint map, triangle;
    vec3 direction; // from the center, a unit vector
    vec3 position;
    real distance;
    real forward; // cosine between the direction and the axis of its face
};

FN CubePlace place_of(uint texel) {
    uint in_map = cube_texels(params.size);
    CubePlace place;
    place.map = texel / in_map;
    vec3 direction = cube_direction(texel % in_map, params.size);
    real extent;
    place.direction = unit_and_length(direction, extent);
    place.forward = real(1.0) / extent;
    place.triangle = map_texels[texel].x;
    place.distance = bits_float(map_texels[texel].y);
    place.position = vec3(centers[place.map]) + place.direction * place.distance;
    return place;
}
