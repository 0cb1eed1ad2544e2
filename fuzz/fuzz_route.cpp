// A router under any settings and any traffic: the first line's bytes are its file, the rest comes in on its endpoints.
// Beyond memory errors it holds that every frame that came in or was meant to go out is counted in one place.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "base/async/loop.hpp"
#include "link/pipe_link.hpp"
#include "require.hpp"
#include "route/config.hpp"
#include "route/metrics.hpp"

namespace {

using namespace lapwing;
using namespace std::chrono_literals;

constexpr std::size_t most_endpoints = 4;

base::Task<> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

/// What the text says, or two endpoints where it says nothing good.
std::vector<route::EndpointOptions> endpoints_of(std::string text) {
  base::SourceFile const source("router.toml", std::move(text));
  base::Diagnostics diagnostics(source);
  auto config = route::read_router_config(source, diagnostics);
  if (diagnostics.has_errors()) fuzz::require(!base::render(diagnostics).empty());
  auto& endpoints = config.endpoints;
  endpoints.resize(std::clamp<std::size_t>(endpoints.size(), 2, most_endpoints));
  for (auto& endpoint : endpoints) route::limit_serial_line(endpoint);
  return endpoints;
}

void require_all_counted(route::Router const& router) {
  for (auto const& status : router.status()) {
    auto const& in = status.counters.in;
    fuzz::require(in.frames == status.parser.frames);
    fuzz::require(in.filtered + in.read_only + in.duplicates + in.unroutable <= in.frames);
  }
  base::OpenMetrics metrics;
  route::write_metrics(std::array<route::Router const*, 1>{&router}, metrics);
  fuzz::require(metrics.text().ends_with("# EOF\n"));
}

}  // namespace

/// Of what comes in, each piece begins with a byte that says on which endpoint and how long it is.
extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::span<std::uint8_t const> input(data, size);
  auto const end = std::ranges::find(input, std::uint8_t{0});
  std::string text(input.begin(), end);
  input = {end, input.end()};

  base::Loop loop(base::Loop::Pace{.unpaced = true});
  std::vector<std::unique_ptr<link::ByteLink>> stations;
  route::Router router(loop, {.max_far_ends = 3}, {});
  for (auto& endpoint : endpoints_of(std::move(text))) {
    auto pipe = link::make_pipe(loop);
    router.add(std::move(endpoint), std::move(pipe.a));
    pipe.b->start([](link::Peer, link::Bytes) {});
    stations.push_back(std::move(pipe.b));
  }
  while (!input.empty()) {
    auto& station = *stations[input.front() % stations.size()];
    auto const length = std::min<std::size_t>(input.size(), 1U + input.front() / 2U);
    station.send(station.standing_peers().front(), input.first(length).subspan(1));
    if (input.front() % 16 == 0) loop.run_until_done(pass(loop, 20ms));
    input = input.subspan(length);
  }
  loop.run_until_done(pass(loop, 2s));
  require_all_counted(router);
  return 0;
}
