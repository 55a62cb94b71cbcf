/// What a picture must hold to before it is decoded. Private to the reader of pictures.
#ifndef MODEL_PICTURE_CHECK_H
#define MODEL_PICTURE_CHECK_H

#include <stdbool.h>
#include <stddef.h>

/// Whether a PNG's chunks end within the file and its data does not begin with an empty one, and a JPEG's Huffman tables within their segments and have 256 codes at most: stb_image
/// takes memory for what a chunk claims, copies an empty one to nowhere, and up to 2.28 writes past its tables. True of what is neither.
bool picture_is_sound(const unsigned char *bytes, size_t size);

#endif
