#include "world/environment_file.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "image/files.hpp"

#include <utility>
#include <vector>

namespace argand {

std::shared_ptr<const SkyPicture> read_sky_picture(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    const std::string name = one_line(path.string(), 4096);
    if (extension != ".hdr" && extension != ".exr") {
        throw UsageError(fmt::format("using '{}' as a sky: its extension is neither .hdr nor .exr; "
                                     "convert it to one of them",
                                     name));
    }
    std::vector<Layer> layers = read_image(path);
    Image picture = whole_picture(layers);
    layers.clear();
    return make_sky_picture(picture.width, picture.height, std::move(picture.pixels), name);
}

} // namespace argand
