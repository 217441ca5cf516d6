// What sim/elasticity/find_volume_stresses.comp has found for a pass of an explicit scheme.
uniform samplerBuffer volume_stresses;  // [Pa], of each node
