// The plane of an overlay that cuts bodies open.
uniform vec4 cut_plane;  // unit normal, minus its offset [m]: positive where bodies are cut away; all 0: nowhere

// Distance of a point from the plane, positive where bodies are kept [m].
float depth_below_cut(vec3 position) { return -(dot(cut_plane.xyz, position) + cut_plane.w); }
