# Lockstep in a container: the steps are those of ./dev, in the Debian that it is made for.
#   docker build -t lockstep .
#   docker run --rm -p 1502:1502 lockstep
# runs the rotary knife in real time, with its Modbus server on port 1502. A project of yours:
#   docker run --rm -p 1502:1502 -v "$PWD/machine:/machine:ro" lockstep run /machine/project.json --no-retain
# Real-time priority and locked memory are the host's to give: --ulimit rtprio=80 --ulimit memlock=-1 --cap-add SYS_NICE
FROM debian:12 AS build
WORKDIR /src
# Packages first: a change of the sources installs nothing anew.
COPY dev ./
RUN ./dev packages
COPY . .
RUN ./dev package && mkdir /out && cp build/release/lockstep_*.deb /out/lockstep.deb

FROM debian:12-slim
COPY --from=build /out/lockstep.deb /tmp/lockstep.deb
RUN apt-get update -q \
  && apt-get install -q -y --no-install-recommends /tmp/lockstep.deb \
  && rm -rf /var/lib/apt/lists/* /tmp/lockstep.deb \
  && useradd --system --create-home --home-dir /var/lib/lockstep lockstep
USER lockstep
WORKDIR /var/lib/lockstep
EXPOSE 1502
STOPSIGNAL SIGTERM
ENTRYPOINT ["lockstep"]
CMD ["run", "/usr/share/lockstep/projects/02_rotary_knife/project.json", "--stimuli", "--no-retain", "--no-lcm", "--modbus", "0.0.0.0:1502"]
