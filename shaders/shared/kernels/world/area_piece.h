// Corners of a piece: the triangle in x, the piece's number (triangle_piece.h) in y.
struct PieceCorners {
    vec3 a, b, c;
};

FN PieceCorners corners_of(uvec2 piece) {
    uvec4 t = triangles[piece.x];
    vec3 a = vec3(positions[t.x]);
    vec3 ab = vec3(positions[t.y]) - a;
    vec3 ac = vec3(positions[t.z]) - a;
    TrianglePiece place = triangle_piece(piece.y);
    PieceCorners corners;
    corners.a = a + ab * place.a.x + ac * place.a.y;
    corners.b = a + ab * place.b.x + ac * place.b.y;
    corners.c = a + ab * place.c.x + ac * place.c.y;
    return corners;
}

FN vec3 middle_of(IN(PieceCorners) p) { return (p.a + p.b + p.c) / real(3.0); }
