// Holds the place until the first support file.
