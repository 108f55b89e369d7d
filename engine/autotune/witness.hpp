#pragma once

#include "autotune/estimate.hpp"
#include "autotune/pilot.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

namespace argand {

/// Renders passes of these settings, as argand::render does with `on_pass`.
using RenderPasses =
    std::function<RenderResult(const RenderSettings& settings, const OnPass& on_pass)>;

/// What a witness says of the squared bias of a picture, all light included.
struct Testimony {
    Estimate pixels; ///< from single pixels: noisy, but it misses nothing
    Estimate smooth; ///< from smoothed pictures: less noise, but it misses the smallest details
};

/// The testimony of the pictures `witness` on the picture whose independent halves are `picture`.
/// seen: the share of the squared bias that makes the difference. guess: for the denominator of
/// relMSE.
Testimony testimony_on(const ImagePair& picture, const ImagePair& witness, double seen,
                       const Image& guess);

enum class Verdict : std::uint8_t { confirmed, refuted, open };

/// What is known of a squared bias before and after a witness has seen the picture.
class Judgement {
public:
    /// usual: what is expected without a witness. most: the largest squared bias to confirm.
    Judgement(const Prior& usual, const Testimony& testimony, double most);

    /// Whether the squared bias is at most `most`, or whether a larger witness is needed to tell.
    Verdict verdict() const;
    Estimate bias() const { return posterior_.estimate(); }
    /// Factor by which the witness must grow to tell, about. More than 1.
    double growth() const;

private:
    Testimony testimony_;
    double most_;
    Posterior posterior_;
};

/// Darkens `guess` where the witness is less than a quarter as bright. A picture that is far too
/// bright would otherwise hide its error in the denominator of relMSE.
Image darkened_by(const ImagePair& witness, const Image& guess);

/// Renders pictures that judge another picture: those of a method without bias, or passes of the
/// same method with narrow bandwidths, where the unbiased one misses some light.
class Witness {
public:
    /// method: that of `pass`, the settings of one pass. It renders with the seeds after that of
    /// `pass`. Keeps references.
    Witness(const RenderPasses& render, const MethodInfo& method, const RenderSettings& pass)
        : render_(render), method_(method), pass_(pass) {}

    /// Adds pictures that exist already. samples: of both halves together; seconds: spent on them.
    void add(const PilotImages& images, double samples, double seconds);

    /// Renders at least a pass for each half, and more until there are `passes`, unless `seconds`
    /// are over. expected: the number of passes that the judged picture is to have. Returns false
    /// if it was interrupted.
    bool render_more(double passes, double seconds, double expected);

    const std::optional<PilotImages>& images() const { return all_.images; }
    /// The light that photons estimate, without bias. Null if the witness has bias.
    const ImagePair* truth() const;
    /// bias: that of the picture (not squared), over that of one pass at the initial bandwidth.
    Testimony testimony(const ImagePair& picture, double bias, const Image& guess) const;

    const RenderSettings& pass() const { return pass_; }
    bool is_unbiased() const { return method_.abilities.unbiased; }
    double passes() const { return all_.samples / pass_.samples; }
    /// Passes without which its own noise is not known well enough to believe it.
    double passes_missing() const;
    double seconds() const { return seconds_; } ///< of its renders, without pictures added
    /// 0 if there are no pictures yet.
    double seconds_per_pass() const { return all_.samples > 0 ? all_.seconds / passes() : 0; }
    /// relMSE of the mean of one pass. Requires pictures.
    double variance_per_pass(const Image& guess) const;

private:
    const RenderPasses& render_;
    const MethodInfo& method_;
    RenderSettings pass_;
    PooledImages all_; ///< with pictures added
    double seconds_ = 0;
    double planned_for_ = 0; ///< passes that narrow bandwidths follow from
    std::uint32_t renders_ = 0;
};

} // namespace argand
