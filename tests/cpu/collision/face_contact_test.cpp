#include "cpu/collision/face_contact.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

using MovingFace = cpu::Moving<double, 3>;

// A face at rest that looks along +z.
const MovingFace kFloor{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};

// A face through the middle of that one, turned by `angle` about the y axis, that moves by `displacement`.
MovingFace make_face(double angle, glm::dvec3 displacement) {
    MovingFace face = kFloor;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = kFloor.start[k] - glm::dvec3(0.25, 0.25, 0.0);
        face.start[k] = {std::cos(angle) * p.x, p.y, -std::sin(angle) * p.x};
        face.end[k] = face.start[k] + displacement;
    }
    return face;
}

constexpr double kTurn = 3.141592653589793;

void expect(const MovingFace& face, cpu::FaceContact ours, cpu::FaceContact theirs) {
    const cpu::FaceContacts touches = cpu::face_contacts(face, kFloor),
                            mirror = cpu::face_contacts(kFloor, face);
    EXPECT_EQ(touches.ours, ours);
    EXPECT_EQ(touches.theirs, theirs);
    EXPECT_EQ(mirror.ours, theirs);
    EXPECT_EQ(mirror.theirs, ours);
}

TEST(FaceContact, TheFrontOfWhatFallsAndWhatItFallsUponEnter) {
    expect(make_face(kTurn, {0, 0, -1}), cpu::FaceContact::enters, cpu::FaceContact::enters);
    expect(make_face(0.8 * kTurn, {1, 0, -1}), cpu::FaceContact::enters, cpu::FaceContact::enters);
}

TEST(FaceContact, TheBackOfWhatFliesThroughDoesNot) {
    expect(make_face(0, {0, 0, -1}), cpu::FaceContact::touches, cpu::FaceContact::enters);
    expect(make_face(kTurn, {0, 0, 1}), cpu::FaceContact::touches, cpu::FaceContact::touches);
}

TEST(FaceContact, SidesOfWhatSlidesDoNot) {
    expect(make_face(0.5 * kTurn, {1, 0, -0.1}), cpu::FaceContact::touches, cpu::FaceContact::touches);
}

TEST(FaceContact, AFaceWithoutAreaDoesNot) {
    MovingFace face = make_face(kTurn, {0, 0, -1});
    face.start[2] = face.start[1];
    expect(face, cpu::FaceContact::touches, cpu::FaceContact::touches);
}

}  // namespace
}  // namespace gelatin
