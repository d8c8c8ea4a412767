# What `cmake --install` puts where, and the Debian package of it (`cpack -G DEB`). The program finds its assets from its own place,
# so that an installed folder can be moved.
include(GNUInstallDirs)

install(TARGETS pathlight)
install(DIRECTORY assets/ DESTINATION "${CMAKE_INSTALL_DATADIR}/pathlight/assets" PATTERN "*.py" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(FILES LICENSE THIRD-PARTY.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
set(pages "${PROJECT_BINARY_DIR}/pages")
install(FILES "${pages}/pathlight.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${pages}/pathlight" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
# Packages of Debian have their completions in vendor-completions, a zsh of elsewhere looks into site-functions.
install(FILES "${pages}/_pathlight" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
install(FILES "${pages}/_pathlight" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")
if(PL_VIEWER)
    install(FILES packaging/pathlight.desktop DESTINATION "${CMAKE_INSTALL_DATADIR}/applications")
    install(FILES packaging/pathlight.svg DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps")
endif()

set(CPACK_PACKAGE_CONTACT "The pathlight authors")
set(CPACK_PACKAGE_VENDOR "The pathlight authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # by dpkg-shlibdeps, of the package dpkg-dev
set(CPACK_GENERATOR DEB)
include(CPack)
