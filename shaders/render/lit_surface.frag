// Only the colour. TEXTURED: that of the texture, in the vertices' light.
#ifdef TEXTURED
#include "render/include/tone.glsl"

uniform sampler2D albedo_texture;  // linear RGB
in vec4 light;
in vec2 uv;
#else
in vec3 color;
#endif
layout(location = 0) out vec4 pixel;

void main() {
#ifdef TEXTURED
    pixel = vec4(to_display(texture(albedo_texture, uv).rgb * light.rgb + light.a), 1.0);
#else
    pixel = vec4(color, 1.0);
#endif
}
