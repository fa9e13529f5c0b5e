# Tests that need a display get one of their own: xvfb-run does not wait for its server to end, and
# a server that ends takes the socket of the next one with the same number with it. A server that
# resets when its last client leaves refuses the next client for a moment: hence -noreset.
find_program(XVFB_RUN xvfb-run REQUIRED)

# Sets `command` to the start of a command line that runs the rest on a new display.
function (gridfem_new_display command)
  get_property(number GLOBAL PROPERTY GRIDFEM_DISPLAYS)
  math(EXPR number "${number} + 1") # empty counts as 0
  set_property(GLOBAL PROPERTY GRIDFEM_DISPLAYS ${number})
  math(EXPR number "100 + ${number}")
  set(${command} ${XVFB_RUN} -n ${number} -a -s "-screen 0 1280x1024x24 -noreset" PARENT_SCOPE)
endfunction ()
