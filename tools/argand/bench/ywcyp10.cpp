#include "ywcyp10.hpp"

#include "ywcyp10_tables.hpp"

#include <algorithm>

namespace argand {

std::vector<std::string> ywcyp10_parts() { return {"making", "images", "hits"}; }

std::vector<PaperTable> bench_ywcyp10(Device& device, const Ywcyp10Settings& settings) {
    std::vector<PaperTable> tables;
    for (const std::string& part : settings.parts.empty() ? ywcyp10_parts() : settings.parts) {
        tables.push_back(part == "making"   ? bench_cube_making(device)
                         : part == "images" ? bench_cube_images(device, settings)
                                            : bench_cube_hits(device, settings));
    }
    return tables;
}

} // namespace argand
