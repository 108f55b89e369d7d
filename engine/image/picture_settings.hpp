#pragma once

#include "image/tone.hpp"

#include <string>

namespace argand {

/// How linear radiance is shown where a picture is encoded as sRGB.
struct Display {
    float exposure_ev = 0; ///< radiance is multiplied by 2^exposure_ev, then the curve applies
    Tone tone = Tone::linear;
};

/// Where an image lies in a larger one, in pixels from its top left corner.
struct CropWindow {
    int x = 0, y = 0;
    int full_width = 0, full_height = 0; ///< of the larger image; 0: the image is whole
};

/// What a picture's file says beside its pixels.
struct PictureSettings {
    Display display;     ///< of formats that are encoded as sRGB
    CropWindow window;   ///< EXR: the data window within the display window
    std::string command; ///< that made it, in UTF-8; empty: none
};

} // namespace argand
