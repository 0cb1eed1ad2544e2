// A job beside the loop and back, ours and two peers': std::async, and Boost Asio's thread_pool with the result posted
// to an io_context. Every job is empty, so what is measured is the way there and back, not the work.
#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <future>
#include <vector>

#include <benchmark/benchmark.h>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include "base/async/pool.hpp"
#include "base/async/scope.hpp"

namespace {

namespace asio = boost::asio;
using lapwing::base::Loop;
using lapwing::base::Scope;
using lapwing::base::Task;

constexpr int batch = 1000;

int add_one(int number) {
  return number + 1;
}

Task<int> ask(Loop& loop, int times) {
  int number = 0;
  for (int i = 0; i < times; ++i) number = co_await loop.on_pool(add_one, number);
  co_return number;
}

Task<> ask_once(Loop& loop, int number, int& sum) {
  sum += co_await loop.on_pool(add_one, number);
}

void ours_one_by_one(benchmark::State& state) {
  Loop loop;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(loop.run_until_done(ask(loop, batch)));
  state.SetItemsProcessed(state.iterations() * batch);
}

void ours_together(benchmark::State& state) {
  Loop loop;
  for ([[maybe_unused]] auto _ : state) {
    Scope scope(loop);
    int sum = 0;
    for (int i = 0; i < batch; ++i) scope.spawn(ask_once(loop, i, sum));
    loop.run_until_done(scope.join());
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * batch);
}

void asio_one_by_one(benchmark::State& state) {
  asio::io_context context{1};
  auto const work = asio::make_work_guard(context);
  asio::thread_pool pool(Loop::one_less_than_cores());
  for ([[maybe_unused]] auto _ : state) {
    int number = 0;
    for (int i = 0; i < batch; ++i) {
      asio::post(pool, [&] { asio::post(context, [&number, result = add_one(number)] { number = result; }); });
      context.run_one();
    }
    benchmark::DoNotOptimize(number);
  }
  state.SetItemsProcessed(state.iterations() * batch);
}

void asio_together(benchmark::State& state) {
  asio::io_context context{1};
  auto const work = asio::make_work_guard(context);
  asio::thread_pool pool(Loop::one_less_than_cores());
  for ([[maybe_unused]] auto _ : state) {
    int sum = 0;
    for (int i = 0; i < batch; ++i)
      asio::post(pool, [&, i] { asio::post(context, [&sum, result = add_one(i)] { sum += result; }); });
    for (int i = 0; i < batch; ++i) context.run_one();
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * batch);
}

void async_one_by_one(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    int number = 0;
    for (int i = 0; i < batch; ++i) number = std::async(std::launch::async, add_one, number).get();
    benchmark::DoNotOptimize(number);
  }
  state.SetItemsProcessed(state.iterations() * batch);
}

BENCHMARK(ours_one_by_one)->Name("ours/one_by_one")->UseRealTime();
BENCHMARK(asio_one_by_one)->Name("asio/one_by_one")->UseRealTime();
BENCHMARK(async_one_by_one)->Name("async/one_by_one")->UseRealTime();
BENCHMARK(ours_together)->Name("ours/together")->UseRealTime();
BENCHMARK(asio_together)->Name("asio/together")->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
