#include "sweep/dynamic.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"
#include "methods/method_info.hpp"
#include "methods/plan_render.hpp"
#include "scene/fingerprint.hpp"
#include "scene/gltf.hpp"
#include "scene/pose.hpp"
#include "session/render.hpp"
#include "world/world.hpp"

#include <array>
#include <numeric>

namespace argand {

namespace {

// Seeds of references. Films use others.
constexpr std::array<std::uint32_t, 2> reference_seeds = {0x80000000u, 0x80000001u};

double time_of(const DynamicScene& film, std::uint64_t frame) {
    return static_cast<double>(frame) / film.fps;
}

/// The images of a film by one seed, those that have references, and what its frames took.
struct RenderedFilm {
    std::map<std::uint64_t, Image> images;
    std::vector<MeasuredFrame> frames;
};

/// a - b.
Image difference(const Image& a, const Image& b) {
    Image result = a;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        result.pixels[i] -= b.pixels[i];
    }
    return result;
}

double mean_error(std::span<const Image> images, const Reference& reference) {
    double sum = 0;
    for (const Image& image : images) {
        sum += rel_mse(image, reference.a, reference.b);
    }
    return sum / static_cast<double>(images.size());
}

/// relMSE of the change between two frames.
double flicker_of(std::span<const Image> images, std::span<const Image> before,
                  const Reference& reference, const Reference& reference_before) {
    const Image a = difference(reference.a, reference_before.a),
                b = difference(reference.b, reference_before.b);
    // What is bright in one of the two frames only counts by half its radiance.
    const Image mean = mean_of(reference.mean(), reference_before.mean());
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t seed = 0; seed < images.size(); ++seed) {
        const Image change = difference(images[seed], before[seed]);
        const std::vector<double> products = rel_products(change, a, change, b, mean);
        sum += std::accumulate(products.begin(), products.end(), 0.0);
        count += products.size();
    }
    return sum / static_cast<double>(count);
}

std::map<std::string, double> stage_seconds(Device& device) {
    std::map<std::string, double> seconds;
    if (device.info().features.timestamps) {
        for (const StageTime& stage : device.stage_times()) {
            seconds[stage.name] = stage.seconds;
        }
    }
    return seconds;
}

/// Renders a film with one seed. Nothing if it was interrupted.
std::optional<RenderedFilm> render_film(Device& device, const DynamicScene& film,
                                        const RenderSettings& settings,
                                        const FilmReferences& references,
                                        const std::function<bool()>& keep_going,
                                        MethodTable methods) {
    Scene scene = load_gltf(film.file.string(), 0.0);
    World world(device, scene);
    Session session(world, scene, settings, methods);
    RenderedFilm rendered;
    for (std::uint64_t frame = 0; frame < film.frames; ++frame) {
        device.wait();
        device.reset_stage_times();
        MeasuredFrame measured{.frame = frame};
        const Clock::time_point start = Clock::now();
        move_without_vertices(time_of(film, frame), scene);
        world.update(scene);
        measured.update_seconds = seconds_since(start);
        session.begin_frame(settings.seed);
        RenderResult result = finish(session, [&](double) { return keep_going(); });
        measured.seconds = seconds_since(start) - measured.update_seconds;
        if (result.statistics.interrupted || !keep_going()) {
            return std::nullopt;
        }
        measured.stage_seconds = stage_seconds(device);
        measured.peak_bytes = device.memory().peak;
        measured.photons_emitted = static_cast<double>(result.statistics.photons_emitted);
        measured.photons_stored = static_cast<double>(result.statistics.photons_stored);
        if (references.contains(frame)) {
            rendered.images[frame] = std::move(result.layers.front().image);
        }
        rendered.frames.push_back(std::move(measured));
    }
    return rendered;
}

/// The same frame's mean over seeds.
MeasuredFrame mean_over_seeds(const std::vector<RenderedFilm>& films, std::size_t index) {
    MeasuredFrame mean = films.front().frames[index];
    const auto average = [&](auto member) {
        double sum = 0;
        for (const RenderedFilm& film : films) {
            sum += film.frames[index].*member;
        }
        mean.*member = sum / static_cast<double>(films.size());
    };
    average(&MeasuredFrame::seconds);
    average(&MeasuredFrame::update_seconds);
    average(&MeasuredFrame::photons_emitted);
    average(&MeasuredFrame::photons_stored);
    for (auto& [stage, seconds] : mean.stage_seconds) {
        seconds = 0;
        for (const RenderedFilm& film : films) {
            const auto& of_film = film.frames[index].stage_seconds;
            const auto found = of_film.find(stage);
            seconds +=
                (found != of_film.end() ? found->second : 0) / static_cast<double>(films.size());
        }
    }
    return mean;
}

std::vector<Image> images_of(const std::vector<RenderedFilm>& films, std::uint64_t frame) {
    std::vector<Image> images;
    images.reserve(films.size());
    for (const RenderedFilm& film : films) {
        images.push_back(film.images.at(frame));
    }
    return images;
}

} // namespace

FrameErrors errors_of(std::uint64_t frame, std::span<const Image> images,
                      std::span<const Image> images_before, const FilmReferences& references) {
    const Reference& reference = references.at(frame);
    FrameErrors errors{.rel_mse = mean_error(images, reference),
                       .variance = rel_variance(images, reference.a, reference.b)};
    errors.squared_bias = errors.rel_mse - errors.variance;
    double least = errors.rel_mse;
    for (const auto& [other, truth] : references) {
        const double error = other < frame ? mean_error(images, truth) : least;
        if (error < least) {
            least = error;
            errors.lag = frame - other;
        }
    }
    if (!images_before.empty()) {
        errors.flicker = flicker_of(images, images_before, reference, references.at(frame - 1));
    }
    return errors;
}

std::optional<FilmReferences> film_references(const OpenDevice& open, const DynamicScene& film,
                                              RenderSettings settings, std::uint32_t samples,
                                              const std::filesystem::path& folder,
                                              const std::function<bool()>& keep_going,
                                              MethodTable methods) {
    settings.samples = samples;
    FilmReferences references;
    std::unique_ptr<Device> device;
    for (const std::uint64_t frame : film.references) {
        const Scene scene = load_gltf(film.file.string(), time_of(film, frame));
        const MethodInfo* unbiased = reference_method(scene, settings, methods);
        if (!unbiased) {
            fail("rendering the references of '{}': no method is unbiased", film.name);
        }
        settings.method = unbiased->name;
        const std::filesystem::path file =
            folder / fmt::format("{}_{}_{}x{}_{}_{}_{:016x}.exr", film.name, frame, settings.width,
                                 settings.height, settings.method, samples,
                                 picture_fingerprint(scene, settings.camera));
        Reference& reference = references[frame];
        if (std::filesystem::exists(file)) {
            reference = reread_reference(file);
            continue;
        }
        if (!device) {
            device = open();
        }
        World world(*device, scene);
        std::array<Image, 2> pair;
        for (std::size_t i = 0; i < pair.size(); ++i) {
            settings.seed = reference_seeds[i];
            RenderResult result = render(
                world, scene, settings, [&](double) { return keep_going(); }, nullptr, methods);
            if (result.statistics.interrupted || !keep_going()) {
                return std::nullopt;
            }
            pair[i] = std::move(result.layers.front().image);
        }
        reference.a = std::move(pair[0]);
        reference.b = std::move(pair[1]);
        write_reference(file, reference);
    }
    return references;
}

std::optional<std::vector<MeasuredFrame>>
measure_film(const OpenDevice& open, const DynamicScene& film, const RenderSettings& settings,
             std::span<const std::uint32_t> seeds, const FilmReferences& references,
             const std::function<bool()>& keep_going, MethodTable methods) {
    const std::unique_ptr<Device> device = open();
    DynamicScene first_frame = film;
    first_frame.frames = 1;
    if (!render_film(*device, first_frame, settings, {}, keep_going, methods)) {
        return std::nullopt;
    }
    std::vector<RenderedFilm> films;
    for (const std::uint32_t seed : seeds) {
        RenderSettings seeded = settings;
        seeded.seed = seed;
        std::optional<RenderedFilm> rendered =
            render_film(*device, film, seeded, references, keep_going, methods);
        if (!rendered) {
            return std::nullopt;
        }
        films.push_back(std::move(*rendered));
    }
    std::vector<MeasuredFrame> frames;
    std::vector<Image> images_before;
    for (std::uint64_t frame = 0; frame < film.frames; ++frame) {
        MeasuredFrame measured = mean_over_seeds(films, frame);
        std::vector<Image> images;
        if (references.contains(frame)) {
            images = images_of(films, frame);
            measured.errors = errors_of(frame, images, images_before, references);
        }
        images_before = std::move(images);
        frames.push_back(std::move(measured));
    }
    return frames;
}

} // namespace argand
