// The index of this invocation in a dispatch that Program::dispatch may have folded into two dimensions.

uint group_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

// A macro, because a function could not name gl_WorkGroupSize before the shader declares its local size. The index may be
// beyond the last element: compare it with the count first.
#define global_index() (group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x)
