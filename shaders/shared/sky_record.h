#ifndef ARGAND_SHARED_SKY_RECORD_H
#define ARGAND_SHARED_SKY_RECORD_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// The words of the buffer with the sky's picture, by which kernels look at it and sample it
// (kernels/sky.h). The picture is equirectangular, with +Y up: a texel's middle is at azimuth
// 2 pi ((column + 1/2) / columns - 1/2) from +X towards +Z, and pi (row + 1/2) / rows below +Y.
// A header of sky_row_0 words, then the rows of cells, their cells and the texels.
CONSTANT uint sky_width = 0u;  // columns of texels
CONSTANT uint sky_height = 1u; // rows of texels
// Cosine and sine of the angle by which the picture is turned about +Y, and then its sun: a disc of
// even radiance. Floats.
CONSTANT uint sky_turn = 2u;
CONSTANT uint sun_towards = 4u;      // unit direction towards it, before the turn
CONSTANT uint sun_height = 7u;       // 1 - cosine of its radius; 0: there is none
CONSTANT uint sun_radiance = 8u;     // [cd/m²]
CONSTANT uint sun_probability = 11u; // with which directions are sampled from it
CONSTANT uint sun_sine2 = 12u;       // squared sine of its radius
CONSTANT uint sky_row_0 = 16u;

// Rows of cells: one between each two rows of texels, and one at either pole. Words of each: the
// start of its range of sky_digits; then floats: the density of directions in the row [1/sr] times
// the number of its cells, and of its upper border at angle t from +Y sin²(t/2) and cos²(t/2). One
// more ends the last row.
CONSTANT uint sky_row_words = 4u;
// Cells: one between each two texels of a row, one word each: the start of its range within the
// row's sky_digits.
CONSTANT uint sky_digits = 0x80000000u;
CONSTANT real SKY_DIGITS = real(2147483648.0);
// Texels: two words each. Radiance is three mantissas of 18 bits, times 2 to the power of a common
// exponent plus 127, which has 8 bits.
CONSTANT uint sky_texel_words = 2u;

ARGAND_SHARED_END

#endif
