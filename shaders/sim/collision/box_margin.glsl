// By how much boxes are larger than what they hold. CPU twin, which says why: gelatin::cpu::BoxMargin.
uniform vec2 box_margin;  // [m], and of the coordinate, a power of two

vec3 margin_at(vec3 point) { return box_margin.x + box_margin.y * abs(point); }
