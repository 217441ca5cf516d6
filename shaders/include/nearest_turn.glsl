// The turn nearest to a map: the orthogonal factor of its polar decomposition, by Newton's method (Higham 1986: "Computing
// the polar decomposition - with applications"). No turn if the map is far from being one.
// CPU twin: gelatin::cpu::nearest_turn.
const float kFlattestTurned = 0.02, kLargestTurned = 50.0;

mat3 nearest_turn(mat3 map) {
    float square = dot(map[0], map[0]) + dot(map[1], map[1]) + dot(map[2], map[2]);
    if (!(determinant(map) > kFlattestTurned && square < kLargestTurned)) return mat3(1.0);
    mat3 turn = map;
    for (int i = 0; i < 10; ++i) turn = 0.5 * (turn + transpose(inverse(turn)));
    return turn;
}
