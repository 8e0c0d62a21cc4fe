// Search of all that a scene may name, of headings of the documents, and of words of the field.
#pragma once

#include <string>
#include <vector>

#include "framework/catalogue/page_headings.hpp"
#include "framework/catalogue/scene_templates.hpp"
#include "framework/config/field.hpp"

namespace tack {

struct SearchSources {
  const Fields* scene = nullptr;  // keys of scenes; not null
  std::vector<SceneTemplate> templates;
  std::vector<PageHeading> headings;
};

// Returns what is found, by section, best matches first; "" if nothing is. Each word of the query
// must begin a word of a name, of a description, or of a term of trade_words(). Components whose
// library is not built are found by their names alone.
std::string search_text(const std::string& query, const SearchSources& sources);

// Returns "; did you mean 'NAME'?" with the nearest name of a kind, a component or a term of
// trade_words(); "" if none is near.
std::string nearest_findable(const std::string& query);

}  // namespace tack
