#include "image/mean.hpp"

namespace argand {

Image weighted_sum(const Image& a, double weight_a, const Image& b, double weight_b) {
    Image sum = a;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
        sum.pixels[i] = weight_a * glm::dvec3(a.pixels[i]) + weight_b * glm::dvec3(b.pixels[i]);
    }
    return sum;
}

Image weighted_mean(const Image& a, double weight_a, const Image& b, double weight_b) {
    const double sum = weight_a + weight_b;
    return weighted_sum(a, weight_a / sum, b, weight_b / sum);
}

} // namespace argand
