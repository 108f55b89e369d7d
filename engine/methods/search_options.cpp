#include "methods/search_options.hpp"

#include "base/error.hpp"
#include "methods/render_options.hpp"

#include <algorithm>
#include <array>

namespace argand {

namespace {

// As QuerySearch numbers them.
constexpr std::array<const char*, 3> search_names = {"auto", "tree", "simultaneous"};

Option query_option() {
    return {.name = "query",
            .help = "How queries find photons: each by itself through a tree over the photons, or "
                    "all together; auto takes the tree",
            .kind = OptionKind::choice,
            .choices = {search_names.begin(), search_names.end()},
            .report_key = "query",
            .get = [](const RenderSettings& settings) -> std::string {
                return search_names[static_cast<std::size_t>(settings.query)];
            },
            .set =
                [](RenderSettings& settings, const std::string& text) {
                    const auto* const name =
                        std::find(search_names.begin(), search_names.end(), text);
                    if (name == search_names.end()) {
                        throw UsageError(
                            fmt::format("reading --query: '{}' is no way to search", text));
                    }
                    settings.query = static_cast<QuerySearch>(name - search_names.begin());
                },
            .sweep = {.full = {"simultaneous"}, .matters = finds_photons}};
}

} // namespace

std::vector<Option> search_options() {
    Option leaf = member_option(
        "query-leaf",
        "With --query simultaneous: queries that are not parted further, whatever that would save",
        [](RenderSettings & s) -> auto& { return s.frontier.query_leaf; }, 1, 1 << 20);
    Option cost = member_option(
        "partition-cost",
        "With --query simultaneous: what it costs to sort a photon to parts of queries, in "
        "comparisons with a query; 0: they are parted down to --query-leaf",
        [](RenderSettings & s) -> auto& { return s.frontier.partition_cost; }, 0, 1e6);
    Option memory = member_option(
        "frontier-memory",
        "With --query simultaneous: bytes for photons that are being sorted to queries",
        [](RenderSettings & s) -> auto& { return s.frontier.memory; }, least_frontier_memory, 1e12);
    return {query_option(), leaf, cost, memory};
}

std::optional<FrontierSettings> frontier_of(const RenderSettings& settings) {
    return settings.query == QuerySearch::simultaneous ? std::optional(settings.frontier)
                                                       : std::nullopt;
}

} // namespace argand
