#pragma once

#include <set>
#include <utility>

#include "base/async/notifier.hpp"

namespace lapwing::station {

/// In a set for as long as it lives; then whoever waits looks again. Of several who want the same work one does it.
template <class Key>
class UnderWay {
 public:
  UnderWay(std::set<Key>& set, Key key, base::Notifier& ended) : set_(set), key_(std::move(key)), ended_(ended) {
    set_.insert(key_);
  }
  UnderWay(UnderWay const&) = delete;
  UnderWay& operator=(UnderWay const&) = delete;
  ~UnderWay() {
    set_.erase(key_);
    ended_.notify_all();
  }

 private:
  std::set<Key>& set_;
  Key key_;
  base::Notifier& ended_;
};

}  // namespace lapwing::station
