def write_page(path, results): pass
