# Bundles the studio's page and writes it as a C++ source: cmake -DESBUILD= -DSOURCE= -DWORK= -DOUTPUT= -P embed.cmake
# The names of what is bundled have a digest, so that browsers may keep them for ever; index.html is told these names.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${WORK})
execute_process(
  COMMAND ${ESBUILD} ${SOURCE}/studio.ts ${SOURCE}/studio.css --bundle --minify --charset=utf8 --target=es2021
          --entry-names=[name]-[hash] --outdir=${WORK} --log-level=warning
  COMMAND_ERROR_IS_FATAL ANY)

# bytes_of(PATH VARIABLE): the bytes of a file as elements of an array.
function(bytes_of path variable)
  file(READ ${path} digits HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
  set(${variable} "${bytes}" PARENT_SCOPE)
endfunction()

set(arrays "")
set(rows "")
# add(FILE PATH TYPE ETAG)
function(add file path type etag)
  bytes_of(${file} bytes)
  string(MAKE_C_IDENTIFIER "${path}" name)
  string(APPEND arrays "constexpr unsigned char k${name}[] = {${bytes}};\n")
  string(APPEND rows "    {\"${path}\", \"${type}\", \"${etag}\", text_of(k${name})},\n")
  set(arrays "${arrays}" PARENT_SCOPE)
  set(rows "${rows}" PARENT_SCOPE)
endfunction()

file(READ ${SOURCE}/index.html index)
set(type_js "text/javascript; charset=utf-8")
set(type_css "text/css; charset=utf-8")
foreach(kind js css)
  file(GLOB bundle ${WORK}/studio-*.${kind})
  get_filename_component(name ${bundle} NAME)
  string(FIND "${index}" "\"assets/studio.${kind}\"" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "index.html does not ask for assets/studio.${kind}")
  endif()
  string(REPLACE "\"assets/studio.${kind}\"" "\"assets/${name}\"" index "${index}")
  add(${bundle} /assets/${name} "${type_${kind}}" "")
endforeach()
file(WRITE ${WORK}/index.html "${index}")
# add_changing(FILE PATH TYPE): one whose name says nothing of what is in it.
macro(add_changing file path type)
  file(SHA256 ${file} digest)
  string(SUBSTRING ${digest} 0 16 digest)
  add(${file} ${path} "${type}" "\\\"${digest}\\\"")
endmacro()
add_changing(${WORK}/index.html / "text/html; charset=utf-8")
add_changing(${SOURCE}/icon.svg /assets/icon.svg image/svg+xml)

file(WRITE ${OUTPUT} "// Made by hmi_bridge/studio/page/embed.cmake.
#include \"hmi_bridge/studio/assets.hpp\"

namespace lockstep {
namespace {

${arrays}
template <std::size_t Size>
std::string_view text_of(const unsigned char (&bytes)[Size]) {
  return {reinterpret_cast<const char*>(bytes), Size};
}

}  // namespace

std::span<const StudioAsset> studio_assets() noexcept {
  static const StudioAsset kAssets[] = {
${rows}  };
  return kAssets;
}

}  // namespace lockstep
")
