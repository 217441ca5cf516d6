// Smooths the steps of edges in a finished picture, where several samples a pixel cost too much: finds the run of
// pixels along which an edge stays in its row or column, and blends across it by the place within the run (the idea
// of Reshetov's MLAA and Lottes' FXAA, 2009).
uniform sampler2D picture;  // alpha: see render/include/tone.glsl
uniform vec2 pixel_size;                        // in texture coordinates

in vec2 uv;
layout(location = 0) out vec4 pixel;

const float kLeastContrast = 0.03;
const float kRelativeContrast = 0.05;
const int kSteps = 12;
const int kSingleSteps = 6;  // the first ones go from pixel to pixel, the others ever farther
const float kGrowth = 1.5;

float key(vec2 at) { return textureLod(picture, at, 0.0).a; }

// How far the edge goes from `start` in a direction [pixels], and whether its end turns to the brighter side.
struct End {
    float distance;
    float key_change;
};
End find_end(vec2 start, vec2 direction, float edge_key, float threshold, int steps) {
    End end = End(0.0, 0.0);
    float stride = 1.0;
    for (int i = 0; i < steps; ++i) {
        end.distance += stride;
        end.key_change = key(start + direction * end.distance) - edge_key;
        if (abs(end.key_change) >= threshold) break;
        if (i >= kSingleSteps) stride *= kGrowth;
    }
    return end;
}

void main() {
    // Two looks at 2 x 2 pixels that share this one.
    vec4 low = textureGather(picture, uv - 0.5 * pixel_size, 3);
    vec4 high = textureGather(picture, uv + 0.5 * pixel_size, 3);
    float self = low.y, west = low.x, south = low.z, north = high.x, east = high.z;
    float darkest = min(self, min(min(west, south), min(north, east)));
    float brightest = max(self, max(max(west, south), max(north, east)));
    float contrast = brightest - darkest;
    int steps = contrast > max(kLeastContrast, kRelativeContrast * brightest) ? kSteps : 0;

    float south_west = low.w, north_east = high.y, south_east = self, north_west = self;
    for (int i = 0; i < min(steps, 1); ++i) {  // few pixels need them, and a loop of no turns costs nothing
        south_east = key(uv + vec2(pixel_size.x, -pixel_size.y));
        north_west = key(uv + vec2(-pixel_size.x, pixel_size.y));
    }
    float rows = abs(north_west + south_west - 2.0 * west) + 2.0 * abs(north + south - 2.0 * self) +
                 abs(north_east + south_east - 2.0 * east);
    float columns = abs(north_west + north_east - 2.0 * north) + 2.0 * abs(west + east - 2.0 * self) +
                    abs(south_west + south_east - 2.0 * south);
    bool horizontal = rows >= columns;
    float before = horizontal ? south : west;
    float after = horizontal ? north : east;
    bool towards_after = abs(after - self) >= abs(before - self);
    float neighbour = towards_after ? after : before;
    vec2 across = (horizontal ? vec2(0.0, pixel_size.y) : vec2(pixel_size.x, 0.0)) * (towards_after ? 1.0 : -1.0);
    vec2 along = horizontal ? vec2(pixel_size.x, 0.0) : vec2(0.0, pixel_size.y);

    float edge_key = 0.5 * (self + neighbour);
    float threshold = 0.25 * abs(neighbour - self);
    vec2 start = uv + 0.5 * across;
    End back = find_end(start, -along, edge_key, threshold, steps);
    End forth = find_end(start, along, edge_key, threshold, steps);
    End nearest = back.distance < forth.distance ? back : forth;
    float run = back.distance + forth.distance;
    // Only at the end where the edge steps over to this pixel's side is there something to blend.
    bool steps_here = (nearest.key_change < 0.0) != (self < edge_key);
    float shift = steps > 0 && steps_here ? 0.5 - nearest.distance / run : 0.0;
    pixel = vec4(textureLod(picture, uv + shift * across, 0.0).rgb, 1.0);
}
