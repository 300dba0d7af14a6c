# isolux_embed_text(TARGET FILE FUNCTION): compiles a text file into TARGET as
#     std::string_view isolux::FUNCTION() noexcept;
# Declare the function in a header of its room. Editing FILE rebuilds it.
function(isolux_embed_text target file function)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(FIND "${text}" ")embedded\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${file} holds the mark that ends an embedded text")
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${function}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include <string_view>

namespace isolux {

std::string_view @function@() noexcept;

std::string_view @function@() noexcept { return R"embedded(@text@)embedded"; }

} // namespace isolux
]])
  target_sources(${target} PRIVATE ${source})
endfunction()
