#pragma once

#include "methods/option.hpp"

namespace argand {

/// The options that methods share. A method lists those that it uses.

/// Of every method.
Option samples_option();
Option bounces_option();
Option follow_roughness_option();
Option cull_back_faces_option();
Option aperture_option();
Option focus_option();
Option filter_option();
Option deterministic_option();

/// Of methods with a photon map, in this order: photons, radius, query-cell, least-coverage,
/// leaf-size, wide-codes, photon-sampling, final-gather.
std::vector<Option> photon_map_options();

/// Widths that fall from pass to pass: progressive, passes, r1, radius-exponent.
std::vector<Option> progressive_options();

/// `samples_option` and all that follow above, then a method's own.
std::vector<Option> all_photon_map_options(const std::vector<Option>& own);

/// Those of make_photon_mapping() by exact rays: all_photon_map_options() and near-field.
std::vector<Option> photon_mapping_options(const std::vector<Option>& own);

/// Whether density estimation has photons to find: what most options of photon maps need to
/// matter.
bool finds_photons(const Variation& variation);

/// An option of a method's own (own_option()) with one of these values, at first the first one.
Option own_choice_option(const std::string& name, const std::string& help,
                         const std::vector<std::string>& choices);

/// An option of a method's own (own_option()) for numbers in [low, high], which a sweep may vary
/// where photons are found.
Option own_number_option(const std::string& name, const std::string& help, OptionKind kind,
                         const std::string& initially, double low, double high);

/// The value at `factor` times a width that a method learnt, rounded so that it is easy to type;
/// empty if it learnt none.
std::string around_width(double learnt, double factor);

} // namespace argand
