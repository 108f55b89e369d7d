#include "methods/queue_ages.hpp"

#include <algorithm>
#include <cmath>

namespace argand {

namespace {

float weight_of(const PhotonQueue& queue, std::uint32_t block, std::uint32_t light) {
    return queue.lights > 1 ? queue.light_weights[block * queue.lights + light]
                            : queue.blocks[block].weight;
}

} // namespace

QueueAges make_ages(std::uint32_t window, std::uint32_t lights) {
    QueueAges ages;
    ages.lights = lights;
    ages.emitted.assign(window, 0);
    ages.half_lives.assign(std::size_t(window) * lights, 0.0);
    return ages;
}

void persist_ages(Archive& archive, QueueAges& ages) {
    archive.value(ages.lights);
    archive.values(ages.emitted);
    archive.values(ages.half_lives);
}

void renew(QueueAges& ages, std::uint32_t block, std::uint64_t emitted) {
    ages.emitted[block] = emitted;
    std::fill_n(ages.half_lives.begin() + std::ptrdiff_t(block) * ages.lights, ages.lights, 0.0);
}

void grow_older(QueueAges& ages, std::uint32_t light, double half_lives) {
    for (std::size_t b = 0; b < ages.emitted.size(); ++b) {
        ages.half_lives[b * ages.lights + light] += half_lives;
    }
}

void weigh_blocks(PhotonQueue& queue, const QueueAges& ages) {
    const auto weight = [&](std::uint32_t b, std::uint32_t light) {
        return queue.blocks[b].moment > 0 ? static_cast<double>(ages.emitted[b]) *
                                                std::exp2(-ages.half_lives[b * ages.lights + light])
                                          : 0;
    };
    queue.light_weights.assign(std::size_t(queue.window) * ages.lights, 0.0f);
    for (std::uint32_t light = 0; light < ages.lights; ++light) {
        double sum = 0;
        for (std::uint32_t b = 0; b < queue.window; ++b) {
            sum += weight(b, light);
        }
        for (std::uint32_t b = 0; b < queue.window; ++b) {
            const auto share = static_cast<float>(sum > 0 ? weight(b, light) / sum : 0);
            queue.light_weights[b * ages.lights + light] = share;
            queue.blocks[b].weight = share; // of the only light, where photons tell none apart
        }
    }
}

double effective_photons(const PhotonQueue& queue, const QueueAges& ages,
                         std::span<const double> shares, std::span<const CrossedShare> crossed) {
    double noise = 0;
    for (const CrossedShare& part : crossed) {
        for (std::uint32_t light = 0; light < ages.lights; ++light) {
            double sum = 0, squares = 0;
            for (std::uint32_t b = 0; b < queue.window; ++b) {
                const auto weight = static_cast<double>(weight_of(queue, b, light));
                if (weight > 0 && queue.blocks[b].moment > part.moment) {
                    sum += weight;
                    squares += weight * weight / static_cast<double>(ages.emitted[b]);
                }
            }
            noise += sum > 0 ? part.share * shares[light] * squares / (sum * sum) : 0;
        }
    }
    return noise > 0 ? 1 / noise : 0;
}

} // namespace argand
