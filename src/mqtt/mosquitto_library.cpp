// SPDX-License-Identifier: MIT
#include "mqtt/mosquitto_library.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace cornerd::mqtt {

namespace {

/// The name that Debian's package libmosquitto1 has had since 2014.
constexpr const char* kName = "libmosquitto.so.1";

template <typename Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(std::string(kName) + " has no " + name);
}

MosquittoLibrary open_library() {
  void* const library = ::dlopen(kName, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(std::string(::dlerror()) + "; install the package libmosquitto1");
  }
  MosquittoLibrary found;
  find(library, "mosquitto_lib_init", found.init);
  find(library, "mosquitto_new", found.create);
  find(library, "mosquitto_destroy", found.destroy);
  find(library, "mosquitto_int_option", found.int_option);
  find(library, "mosquitto_threaded_set", found.threaded_set);
  find(library, "mosquitto_username_pw_set", found.username_pw_set);
  find(library, "mosquitto_tls_set", found.tls_set);
  find(library, "mosquitto_will_set", found.will_set);
  find(library, "mosquitto_connect_callback_set", found.connect_callback_set);
  find(library, "mosquitto_disconnect_callback_set", found.disconnect_callback_set);
  find(library, "mosquitto_message_callback_set", found.message_callback_set);
  find(library, "mosquitto_publish_v5_callback_set", found.publish_v5_callback_set);
  find(library, "mosquitto_connect_bind_v5", found.connect_bind_v5);
  find(library, "mosquitto_disconnect", found.disconnect);
  find(library, "mosquitto_loop", found.loop);
  find(library, "mosquitto_publish", found.publish);
  find(library, "mosquitto_subscribe", found.subscribe);
  find(library, "mosquitto_unsubscribe", found.unsubscribe);
  find(library, "mosquitto_want_write", found.want_write);
  find(library, "mosquitto_strerror", found.strerror);
  find(library, "mosquitto_reason_string", found.reason_string);
  find(library, "mosquitto_connack_string", found.connack_string);
  find(library, "mosquitto_property_add_int32", found.property_add_int32);
  find(library, "mosquitto_property_free_all", found.property_free_all);
  found.init();
  return found;
}

}  // namespace

const MosquittoLibrary& mosquitto_library() {
  static const MosquittoLibrary kLibrary = open_library();
  return kLibrary;
}

}  // namespace cornerd::mqtt
