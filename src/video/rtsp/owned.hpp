#pragma once

#include <memory>

#include <glib-object.h>

namespace lapwing::video {

struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
/// One reference to an object of GLib's.
template <class Object>
using Owned = std::unique_ptr<Object, Unref>;

}  // namespace lapwing::video
