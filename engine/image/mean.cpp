#include "image/mean.hpp"

namespace argand {

Image weighted_mean(const Image& a, double weight_a, const Image& b, double weight_b) {
    const double share_a = weight_a / (weight_a + weight_b);
    const double share_b = weight_b / (weight_a + weight_b);
    Image mean = a;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
        mean.pixels[i] = share_a * glm::dvec3(a.pixels[i]) + share_b * glm::dvec3(b.pixels[i]);
    }
    return mean;
}

} // namespace argand
