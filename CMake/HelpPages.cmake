# Makes the pages of the help that ParaView shows out of those in Plugin/Documentation. Run with
#   cmake -DSOURCE=<project> -DOUTPUT=<folder> -DCMARK=<cmark-gfm> -P HelpPages.cmake
# The question mark of a panel opens the page filters.<Proxy>.html.

# Sets `name` to the name of the page for a Markdown file.
function (page_name source name)
  get_filename_component(stem ${source} NAME_WE)
  if (EXISTS ${SOURCE}/Plugin/${stem}.xml)
    set(stem filters.${stem})
  endif ()
  set(${name} ${stem}.html PARENT_SCOPE)
endfunction ()

function (write_page name title body)
  file(WRITE ${OUTPUT}/${name} "<html>\n<head><meta charset=\"utf-8\"/><title>${title}</title></head>\n"
    "<body>\n${body}</body>\n</html>\n")
endfunction ()

file(GLOB sources ${SOURCE}/Plugin/Documentation/*.md)
foreach (source IN LISTS sources)
  execute_process(COMMAND ${CMARK} --extension table --to html ${source}
    OUTPUT_VARIABLE body COMMAND_ERROR_IS_FATAL ANY)
  foreach (other IN LISTS sources)
    get_filename_component(target ${other} NAME)
    page_name(${other} page)
    string(REPLACE "href=\"${target}" "href=\"${page}" body "${body}")
  endforeach ()
  # What is not in the help is named, but no link.
  string(REGEX REPLACE "<a href=\"\\.\\./[^\"]*\">([^<]*)</a>" "\\1" body "${body}")
  # Qt's viewer knows no style sheets for tables and shows pictures in their full size.
  string(REPLACE "<table>" "<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">" body "${body}")
  string(REGEX MATCHALL "[a-z_]+\\.png" pictures "${body}")
  foreach (picture IN LISTS pictures)
    file(COPY ${SOURCE}/Examples/Pictures/${picture} DESTINATION ${OUTPUT})
  endforeach ()
  string(REGEX REPLACE "src=\"[^\"]*/([a-z_]+\\.png)\"" "width=\"640\" src=\"\\1\"" body "${body}")

  string(REGEX MATCH "<h1>([^<]*)</h1>" heading "${body}")
  set(title "${CMAKE_MATCH_1}")
  page_name(${source} page)
  write_page(${page} "${title}" "${body}")
  if (page MATCHES "^filters")
    string(APPEND filters "<li><a href=\"${page}\">${title}</a></li>\n")
  else ()
    string(APPEND shared "<li><a href=\"${page}\">${title}</a></li>\n")
  endif ()
endforeach ()
string(CONCAT body "<h1>GridFEM</h1>\n<p>Equations on the surface of a mesh.</p>\n"
  "<h2>Filters</h2>\n<ul>\n${filters}</ul>\n<h2>What they have in common</h2>\n<ul>\n${shared}</ul>\n")
write_page(index.html "GridFEM" "${body}")
