// A face as seen in a view, made conservative: for each pixel whose square it touches, a range of depths that contains all of
// it there. Stages that write it define FOOTPRINT as out, those that read it as in.
FOOTPRINT Footprint {
    flat vec3 edges[3];      // dot(edge, (pixel centre, 1)) >= 0 where the pixel touches the edge's inner side
    flat vec3 corner;        // a point of the face: x and y [pixels], depth
    flat vec2 slope;         // of depth [1/pixel]
    flat float depth_reach;  // how far depth within a pixel is from that at its centre, at most
    flat vec2 depth_range;   // of the whole face
    flat uint face;
    flat uint object;
} footprint;
