// How much larger boxes are than their content. CPU twin, which explains it: gelatin::cpu::BoxMargin.
uniform vec2 box_margin;  // [m], and of the coordinate, a power of two

vec3 margin_at(vec3 point) { return box_margin.x + box_margin.y * abs(point); }
