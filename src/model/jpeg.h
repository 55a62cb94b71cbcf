/// What a JPEG must hold to before it is decoded. Private to the reader of pictures.
#ifndef MODEL_JPEG_H
#define MODEL_JPEG_H

#include <stdbool.h>
#include <stddef.h>

/// Whether each Huffman table has the 256 codes that there may be at most, and ends within its segment: stb_image up to 2.28
/// writes past its own where a file claims more. True of what is no JPEG.
bool jpeg_tables_fit(const unsigned char *bytes, size_t size);

#endif
