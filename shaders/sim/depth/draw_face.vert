// A point a face, which face_footprint.geom turns into what the face covers.
uniform usamplerBuffer drawn_faces;

flat out uint drawn_face;

void main() {
    drawn_face = texelFetch(drawn_faces, gl_VertexID).x;
    gl_Position = vec4(0.0);
}
