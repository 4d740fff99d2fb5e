// The text that a case is known by, and its hash. The words of this text are kept for ever: a change of a key, of the
// number format or of the order gives every case a new id.
#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "runner/study/field_reader.h"
#include "runner/study/json_value.h"
#include "runner/study/resolved.h"
#include "runner/study/sha256.h"
#include "runner/study/study.h"
#include "solver/scene/analysis.h"

namespace seapile::study {
namespace {

/// Members of one object as they will be written: sorted by key.
using Members = std::map<std::string, std::string>;

std::string object_text(const Members& members) {
  std::string text = "{";
  for (const auto& [key, value] : members) {
    if (text.size() > 1) text += ',';
    text += nlohmann::json(key).dump() + ":" + value;
  }
  return text + "}";
}

std::string string_text(const std::string& text) { return nlohmann::json(text).dump(); }

std::string double_text(double number) {
  if (!std::isfinite(number)) throw std::logic_error("a scene holds a number that is not finite");
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number == 0 ? 0.0 : number).ptr;
  return std::string(buffer.data(), end);
}

/// What a text is for: identity leaves out what a case does not use and what was added later and holds its default; a
/// worker is handed everything.
enum class Purpose { identity, handover };

template <Purpose kPurpose, class Spec>
Members members_of(const Spec& spec);

template <Purpose kPurpose, class T>
std::string member_text(const T& member) {
  if constexpr (kIsOptional<T>) {
    return member ? member_text<kPurpose>(*member) : "null";
  } else if constexpr (kIsVariant<T>) {
    return std::visit(
        [](const auto& alternative) {
          return object_text(
              {{std::remove_cvref_t<decltype(alternative)>::kName, object_text(members_of<kPurpose>(alternative))}});
        },
        member);
  } else if constexpr (std::is_same_v<T, double>) {
    return double_text(member);
  } else if constexpr (std::is_same_v<T, bool>) {
    return member ? "true" : "false";
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(member);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return string_text(member);
  } else if constexpr (std::is_enum_v<T>) {
    return string_text(base::EnumNames<T>::values[static_cast<std::size_t>(member)]);
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    std::string text = "[";
    for (const double number : member) text += (text.size() > 1 ? "," : "") + double_text(number);
    return text + "]";
  } else {
    return object_text(members_of<kPurpose>(member));
  }
}

template <Purpose kPurpose, class Spec>
Members members_of(const Spec& spec) {
  Members members;
  const auto visit = [&](const base::Field& field, const auto& member) {
    members[std::string(field.key)] = member_text<kPurpose>(member);
  };
  fields(visit, spec);
  if constexpr (kPurpose == Purpose::handover) return members;

  const Spec untouched;
  const auto leave_out_default = [&](const base::Field& field, const auto& member) {
    const std::string key(field.key);
    if (field.later && members[key] == member_text<kPurpose>(member)) members.erase(key);
  };
  fields(leave_out_default, untouched);
  if constexpr (std::is_same_v<Spec, grains::ContactSpec>)
    std::erase_if(members, [&](const auto& entry) { return !uses(spec, entry.first); });
  return members;
}

/// What is forced of the model is written, and nothing else; to identity belongs only what the scene has a choice
/// about.
template <Purpose kPurpose>
void put_model(Members& members, const scene::SceneSpec& scene) {
  Members model = members_of<Purpose::identity>(scene.model);
  if constexpr (kPurpose == Purpose::identity)
    std::erase_if(model, [&](const auto& entry) { return !scene::has_choice(scene, entry.first); });
  members.erase("model");
  if (!model.empty()) members["model"] = object_text(model);
}

/// Water alone: the one part that such a scene consists of, and what is forced of its model.
template <Purpose kPurpose>
Members water_members(const scene::SceneSpec& scene) {
  Members members;
  if (scene.jet)
    members["jet"] = object_text(members_of<kPurpose>(*scene.jet));
  else
    members["basin"] = object_text(members_of<kPurpose>(*scene.basin));
  put_model<kPurpose>(members, scene);
  return members;
}

/// Reads what to_json() wrote.
Value read_own(const std::string& text, const std::string& name) {
  base::Problems problems;
  Value value = read_json(text, "", problems);
  if (!problems.empty()) throw BadInput(name, std::move(problems));
  return value;
}

/// Takes a member out of an object that may have it.
std::string take_string(Value* object, const std::string& key, base::Problems& problems) {
  std::string text;
  if (!object || object->kind != Value::Kind::object) return text;
  if (const Value* member = object->find(key)) {
    read_string(*member, text, problems);
    const auto at = member - object->items.data();
    object->keys.erase(object->keys.begin() + at);
    object->items.erase(object->items.begin() + at);
  }
  return text;
}

}  // namespace

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw std::logic_error("SHA-256 is not available");
  }
  std::string text;
  for (unsigned i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

std::string case_id(const std::string& canonical) { return sha256(canonical); }

std::string canonical_text(const scene::BedSpec& bed) {
  // Grains from a file are known by what they are, wherever the file lies.
  Members members = members_of<Purpose::identity>(bed);
  members.erase("file");
  members["file_content"] = string_text(bed.file_content);
  return object_text(members);
}

std::string canonical_text(const scene::SceneSpec& scene, const std::string& bed_id) {
  if (is_water(scene)) return object_text(water_members<Purpose::identity>(scene));
  // Without a pile nothing is done to the bed, and the case is the bed.
  if (!scene.pile) return canonical_text(scene.bed);
  Members members = members_of<Purpose::identity>(scene);
  members["bed"] = string_text(bed_id);
  put_model<Purpose::identity>(members, scene);
  return object_text(members);
}

Case case_of(const scene::SceneSpec& scene) {
  Case one;
  one.scene = scene;
  if (!is_water(scene)) {
    one.bed_canonical = canonical_text(scene.bed);
    one.bed_id = case_id(one.bed_canonical);
  }
  one.canonical = canonical_text(scene, one.bed_id);
  one.id = case_id(one.canonical);
  return one;
}

std::string canonical_text(const scene::RecordSpec& record) {
  return object_text(members_of<Purpose::identity>(record));
}

std::string to_json(const scene::SceneSpec& scene) {
  if (is_water(scene)) return object_text(water_members<Purpose::handover>(scene));
  Members bed = members_of<Purpose::handover>(scene.bed);
  if (!scene.bed.file_content.empty()) bed["file_content"] = string_text(scene.bed.file_content);
  Members members = members_of<Purpose::handover>(scene);
  members["bed"] = object_text(bed);
  members.erase("jet");
  members.erase("basin");
  put_model<Purpose::handover>(members, scene);
  return object_text(members);
}

scene::SceneSpec scene_from_json(const std::string& text) {
  Value value = read_own(text, "scene");
  base::Problems problems;
  std::string file_content;
  if (value.kind == Value::Kind::object) file_content = take_string(value.find("bed"), "file_content", problems);
  scene::SceneSpec scene;
  read_spec(value, scene, problems);
  scene.bed.file_content = file_content;
  if (!problems.empty()) throw BadInput("scene", std::move(problems));
  return scene;
}

std::string to_json(const scene::RecordSpec& record) { return object_text(members_of<Purpose::handover>(record)); }

std::string to_json(const scene::RecordSpec& record, const scene::SceneSpec& scene) {
  Members members = members_of<Purpose::handover>(record);
  std::erase_if(members, [&](const auto& entry) { return !heeds(scene, entry.first); });
  return object_text(members);
}

scene::RecordSpec record_of(const scene::RecordSpec& record, const scene::SceneSpec& scene) {
  return record_from_json(to_json(record, scene));
}

scene::RecordSpec record_from_json(const std::string& text) {
  const Value value = read_own(text, "record");
  base::Problems problems;
  scene::RecordSpec record;
  read_spec(value, record, problems);
  if (!problems.empty()) throw BadInput("record", std::move(problems));
  return record;
}

}  // namespace seapile::study
