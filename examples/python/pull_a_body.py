"""Pulls a soft block that is glued to the floor, and reads the force: its stiffness, as a testing machine finds it.

python pull_a_body.py
"""

import numpy as np

import gelatin

YOUNGS_MODULUS = 5e4  # [Pa]
SIZE = np.array([0.1, 0.4, 0.1])  # [m]


def main():
    scene = gelatin.Scene()
    scene.simulation.gravity = (0, 0, 0)
    scene.add_material("rubber", model="neo_hookean", youngs_modulus=YOUNGS_MODULUS, damping=0.02)
    scene.add(
        "block",
        gelatin.Box(SIZE, segments=(3, 12, 3)),
        material="rubber",
        position=(0, SIZE[1] / 2, 0),
        pins=[gelatin.HalfSpaceRegion((0, 1, 0), 1e-6)],
    )
    sim = gelatin.Simulator(scene, backend="cpu")
    block = sim["block"]
    top = block.nodes_in(gelatin.HalfSpaceRegion((0, -1, 0), -SIZE[1] + 1e-6))
    hand = block.hold(top, stiffness=1e5)

    strains, forces = [], []
    for pull in np.linspace(0.0, 0.02, 5):
        hand.target = (0, SIZE[1] + pull, 0)
        sim.advance(120)  # until it is at rest
        strains.append(block.positions[top, 1].mean() / SIZE[1] - 1)
        forces.append(hand.force[1])
        print(f"strain {strains[-1]:6.2%}: {forces[-1]:6.2f} N")

    modulus = np.polyfit(strains, forces, 1)[0] / (SIZE[0] * SIZE[2])
    print(f"Young's modulus from the slope: {modulus:.3g} Pa; of the material: {YOUNGS_MODULUS:.3g} Pa")
    # Held at both ends, it cannot become thinner there: it is a little stiffer than a bar that can.
    assert 0.95 * YOUNGS_MODULUS < modulus < 1.1 * YOUNGS_MODULUS
    hand.release()
    sim.advance(240)
    assert abs(block.positions[top, 1].mean() - SIZE[1]) < 1e-3, "it has its shape back"


if __name__ == "__main__":
    main()
