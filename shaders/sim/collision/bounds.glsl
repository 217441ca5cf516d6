// Boxes, closed; empty where min > max. CPU twin: gelatin::cpu::AxisBox.
struct Bounds {
    vec3 min;
    vec3 max;
};

bool meet(vec3 min_a, vec3 max_a, vec3 min_b, vec3 max_b) {
    return all(lessThanEqual(min_a, max_b)) && all(lessThanEqual(min_b, max_a));
}
bool meet(Bounds a, Bounds b) { return meet(a.min, a.max, b.min, b.max); }
