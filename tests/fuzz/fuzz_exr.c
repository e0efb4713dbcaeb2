/* The input is an OpenEXR file: read as any, and as a passes file. */
#include "fuzz_support.h"

#include "exr_io.h"
#include "passes_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct exr_contents contents;
    struct gbuffer gbuffer;
    struct error err = {0};
    const char *path = fuzz_file(data, size);
    enum result result = exr_read(path, &contents, &err);
    FUZZ_REQUIRE(strncmp(err.text, "out of memory", 13));
    FUZZ_REQUIRE(result == RESULT_OK || (result == RESULT_DATA && *err.text && !contents.image.pixels));
    exr_contents_free(&contents);
    if (passes_file_read(path, &gbuffer, &err) == RESULT_OK)
        FUZZ_REQUIRE(gbuffer.specular.pixels && gbuffer.position.pixels && gbuffer.endpoint.pixels);
    gbuffer_free(&gbuffer);
    return 0;
}
