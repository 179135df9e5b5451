# boxwood_embed_shaders(TARGET FILE...): puts the text of shader files into TARGET; see shader_source() in
# app/gl/program.h. Run as a script (-P), the same file writes the source from OUTPUT and FILES.
if(CMAKE_SCRIPT_MODE_FILE)
    set(text "#include \"app/gl/embedded_shaders.h\"\n\nnamespace boxwood {\n\n")
    string(APPEND text "const std::vector<EmbeddedShader>& embedded_shaders() {\n")
    string(APPEND text "    static const std::vector<EmbeddedShader> shaders = {\n")
    foreach(file IN LISTS FILES)
        get_filename_component(name "${file}" NAME)
        file(READ "${file}" source)
        string(APPEND text "{\"${name}\", R\"boxwood(${source})boxwood\"},\n")
    endforeach()
    string(APPEND text "    };\n    return shaders;\n}\n\n}  // namespace boxwood\n")
    file(WRITE "${OUTPUT}" "${text}")
    return()
endif()

set(boxwood_embed_script "${CMAKE_CURRENT_LIST_FILE}")
function(boxwood_embed_shaders target)
    set(output "${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp")
    list(TRANSFORM ARGN PREPEND "${CMAKE_SOURCE_DIR}/shaders/" OUTPUT_VARIABLE files)
    add_custom_command(
        OUTPUT "${output}"
        COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${output}" "-DFILES=${files}" -P "${boxwood_embed_script}"
        DEPENDS ${files} "${boxwood_embed_script}"
        COMMENT "Embedding the shaders"
        VERBATIM)
    target_sources(${target} PRIVATE "${output}")
endfunction()
