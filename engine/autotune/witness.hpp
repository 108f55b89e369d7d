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

/// What witnesses say of the squared bias of a picture.
struct Testimony {
    Estimate pixels; ///< from single pixels: noisy, but it misses nothing
    Estimate smooth; ///< from smoothed pictures: less noise, but it misses the smallest details
    /// That of caustics, if narrow passes measured it apart: the others are of all other light.
    Estimate caustics{0, 0};
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
    Estimate bias() const;
    /// Whether the testimony alone says that it is larger than that.
    bool speaks_against() const { return testimony_.pixels.value > most_of_others_; }
    /// Whether the noise of the testimony on caustics keeps it from telling.
    bool caustics_are_in_doubt() const;
    /// Factor by which the witness must grow to tell, about. More than 1.
    double growth() const;

private:
    Testimony testimony_;
    double most_, most_of_others_;
    Posterior posterior_; ///< of all light but what caustics is of
};

/// Darkens `guess` where the witness is less than a quarter as bright. A picture that is far too
/// bright would otherwise hide its error in the denominator of relMSE.
Image darkened_by(const ImagePair& witness, const Image& guess);

/// A narrow witness has the bandwidth of a render of so many times the passes: half the bandwidth.
/// Narrower ones see more of the bias, but their noise grows faster.
inline constexpr double times_passes = 64;
/// Caustics may fall to a few pixels. There photons lie so dense that a third of the bandwidth has
/// little noise.
inline constexpr double times_passes_of_caustics = 729;

/// Changes `blurred` as far as both of two narrow pictures agree, for the denominator of relMSE:
/// blur would otherwise hide its own error there.
Image sharpened_by(const ImagePair& narrow, const Image& blurred);

/// Renders pictures that judge another picture: those of a method without bias, or passes of the
/// same method with narrow bandwidths, where the unbiased one misses some light.
class Witness {
public:
    /// method: that of `pass`, the settings of one pass. It renders with the seeds after that of
    /// `pass`. narrow_for: the factor of passes that its bandwidth follows from, if it has bias.
    /// Keeps references.
    Witness(const RenderPasses& render, const MethodInfo& method, const RenderSettings& pass,
            double narrow_for = times_passes)
        : render_(render), method_(method), pass_(pass), narrow_for_(narrow_for) {}

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
    /// Of the squared bias of the caustics of a picture.
    Estimate testimony_on_caustics(const ImagePair& caustics, double bias,
                                   const Image& guess) const;

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
    double own_bias() const;

    RenderSettings pass_;
    double narrow_for_;
    PooledImages all_; ///< with pictures added
    double seconds_ = 0;
    double planned_for_ = 0; ///< passes that narrow bandwidths follow from
    std::uint32_t renders_ = 0;
};

} // namespace argand
