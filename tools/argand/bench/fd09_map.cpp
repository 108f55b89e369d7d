#include "fd09_map.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "methods/plan_render.hpp"
#include "photon/radius.hpp"
#include "session/render.hpp"
#include "world/world.hpp"

#include <algorithm>
#include <ctime>

namespace argand {

PaperMap trace_paper_map(Device& device, const Scene& scene, const RenderSettings& render) {
    PaperMap paper;
    paper.render = render;
    paper.render.method = "footprints";
    paper.render.photons = std::min(render.photons, max_photons_per_pass(device));
    paper.render.photons_per_pass =
        std::max<std::uint64_t>(paper.render.photons, 1); // one map of all photons
    paper.statistics =
        argand::render(device, scene, paper.render, [](double) { return true; }).statistics;
    if (!paper.statistics.footprint_scale || paper.statistics.photons_stored == 0) {
        fail("measuring '{}': no photon is stored; choose a scene with a light and a surface that "
             "scatters it twice",
             scene.name);
    }
    paper.scene = upload_scene(device, scene, plan_render(scene, paper.render));
    paper.workspace =
        make_photon_workspace(device, paper.render.photons, {.extents = extents_differentials});
    const PhotonPass pass{
        .seed = render.seed, .first = 0, .count = paper.render.photons, .bounces = render.bounces};
    const std::optional<StoredPhotons> stored =
        trace_photons(device, paper.scene, paper.workspace, pass, 1e-6f);
    if (!stored) {
        fail("measuring '{}': the photons that are stored exceed what '{}' can address; use fewer "
             "photons",
             scene.name, device.info().name);
    }
    paper.stored = *stored;
    paper.settings = {.area_samples =
                          area_samples(paper.scene.surface_area, paper.statistics.radius),
                      .seed = render.seed,
                      .footprints = paper.statistics.footprint_scale};
    paper.eye = make_eye_workspace(
        device, paper.scene.plan, paper.render,
        camera_record(scene.cameras[render.camera], render.width, render.height));
    return paper;
}

PhotonMap build(Device& device, PaperMap& paper, std::uint32_t leaf_size) {
    PhotonMapSettings settings = paper.settings;
    settings.leaf_size = leaf_size;
    return build_photon_map(device, paper.scene, paper.workspace, paper.stored, settings);
}

double seconds_of(Device& device, const std::function<void()>& work) {
    device.wait();
    const std::clock_t processor = std::clock();
    const Clock::time_point start = Clock::now();
    work();
    device.wait();
    return device.info().kind == DeviceKind::cpu
               ? static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC
               : seconds_since(start);
}

} // namespace argand
