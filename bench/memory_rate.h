#pragma once

namespace gelatin {

/// Bytes a second that are read and written while a buffer too large for caches is copied: the most that what
/// moves data could reach. The best of a few copies.
/// @{
double cpu_memory_rate(int threads);
/// Needs a context.
double device_memory_rate();
/// @}

}  // namespace gelatin
