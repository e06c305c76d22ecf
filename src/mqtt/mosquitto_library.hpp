// SPDX-License-Identifier: MIT
#pragma once

#include <mosquitto.h>

#include <string>

namespace cornerd::mqtt {

/// libmosquitto, opened when it is first needed: a package that can do without a broker does not
/// depend on it, and a cross build needs its header alone.
struct MosquittoLibrary {
  decltype(&mosquitto_lib_init) init = nullptr;
  decltype(&mosquitto_new) create = nullptr;
  decltype(&mosquitto_destroy) destroy = nullptr;
  decltype(&mosquitto_int_option) int_option = nullptr;
  decltype(&mosquitto_threaded_set) threaded_set = nullptr;
  decltype(&mosquitto_username_pw_set) username_pw_set = nullptr;
  decltype(&mosquitto_tls_set) tls_set = nullptr;
  decltype(&mosquitto_will_set) will_set = nullptr;
  decltype(&mosquitto_connect_callback_set) connect_callback_set = nullptr;
  decltype(&mosquitto_disconnect_callback_set) disconnect_callback_set = nullptr;
  decltype(&mosquitto_message_callback_set) message_callback_set = nullptr;
  decltype(&mosquitto_publish_v5_callback_set) publish_v5_callback_set = nullptr;
  decltype(&mosquitto_connect_bind_v5) connect_bind_v5 = nullptr;
  decltype(&mosquitto_disconnect) disconnect = nullptr;
  decltype(&mosquitto_loop) loop = nullptr;
  decltype(&mosquitto_publish) publish = nullptr;
  decltype(&mosquitto_subscribe) subscribe = nullptr;
  decltype(&mosquitto_unsubscribe) unsubscribe = nullptr;
  decltype(&mosquitto_want_write) want_write = nullptr;
  decltype(&mosquitto_strerror) strerror = nullptr;
  decltype(&mosquitto_reason_string) reason_string = nullptr;
  decltype(&mosquitto_connack_string) connack_string = nullptr;
  decltype(&mosquitto_property_add_int32) property_add_int32 = nullptr;
  decltype(&mosquitto_property_free_all) property_free_all = nullptr;
};

/// Throws std::runtime_error, with the package to install, where there is none.
const MosquittoLibrary& mosquitto_library();

}  // namespace cornerd::mqtt
