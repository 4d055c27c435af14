// Publishes known instants as ROS 2 topics, and prints each as a line of JSON.   ros_publisher DOMAIN READERS COUNT [INTERFACE PEERS]
// Waits until READERS readers are matched, all topics together; ends when its standard input does.
// SPDX-License-Identifier: MIT
#include "ins/quat.h"
#include "ins_dds/ros.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define PERIOD_US 10000
#define WAIT_S    60

/// Positive definite, with every correlation its own.
static void covariance(double P[INS_NAVIGATION_P * INS_NAVIGATION_P])
{
    const double sigma[INS_NAVIGATION_P] = {0.01, 0.02, 0.03, 0.1, 0.2, 0.3, 1, 2, 3};
    const int n = INS_NAVIGATION_P;
    for (int i = 0; i < n; i++)
    {
        for (int j = 0; j < n; j++)
        {
            P[n * i + j] = sigma[i] * sigma[j] * (i == j ? 1 : 0.05 * cos(i * j + i + j));
        }
    }
}

static void print_array(const char* name, const double* x, int count)
{
    printf("\"%s\":[", name);
    for (int i = 0; i < count; i++)
    {
        printf("%s%.17g", i > 0 ? "," : "", x[i]);
    }
    printf("],");
}

static int fail(const char* what)
{
    fprintf(stderr, "ros_publisher: %s: %s\n", what, ins_dds_error_text());
    return 1;
}

static int matched(ins_ros_t* ros)
{
    int readers = 0;
    for (int topic = 0; topic < INS_ROS_TOPICS; topic++)
    {
        readers += ins_ros_matched(ros, (ins_ros_topic_t)topic);
    }
    return readers;
}

int main(int argc, char** argv)
{
    if (argc != 4 && argc != 6)
    {
        return 2;
    }
    ins_ros_config_t cfg;
    ins_ros_t* ros = NULL;
    ins_ros_config_default(&cfg);
    cfg.dds.domain = (uint32_t)atoi(argv[1]);
    if (argc == 6)
    {
        cfg.dds.network = INS_DDS_INTERFACE;
        cfg.dds.interface = argv[4];
        cfg.dds.peers = argv[5];
    }
    cfg.name_space = "/car";
    for (int topic = 0; topic < INS_ROS_TOPICS; topic++)
    {
        cfg.topic[topic].qos.history = 1000; // a reader may fall behind: every instant is to arrive
    }
    cfg.rate_sigma = 0.003;
    cfg.force_sigma = 0.04;
    cfg.topic[INS_ROS_TWIST].decimate = 5;
    if (ins_ros_open(&cfg, &ros) != INS_DDS_OK)
    {
        return fail("open");
    }
    for (int i = 0; matched(ros) < atoi(argv[2]); i++)
    {
        if (i > WAIT_S * 1000)
        {
            return fail("no reader came");
        }
        usleep(1000);
    }
    const int count = atoi(argv[3]);
    for (int k = 0; k < count; k++)
    {
        ins_navigation_t n = {1700000000123456789 + (int64_t)k * 10000000,
                              INS_NAVIGATION_HOST,
                              0xFF,
                              {0},
                              {0.1, -0.2, 0.3},
                              {0.5, -0.6, -9.7},
                              {10, -3, 0.5},
                              {0.8 + 1e-5 * k, -1.9 + 1e-5 * k, 123.25},
                              {0}};
        const double euler[3] = {0.1, -0.2, 2.5 + 0.01 * k};
        ins_quat_from_euler(euler, n.q_nb);
        covariance(n.P);
        if (ins_ros_publish(ros, &n) != INS_DDS_OK)
        {
            return fail("publish");
        }
        printf("{\"time_ns\":%lld,", (long long)n.time_ns);
        print_array("euler", euler, 3);
        print_array("w_ib_b", n.w_ib_b, 3);
        print_array("f_b", n.f_b, 3);
        print_array("v_n", n.v_n, 3);
        print_array("P", n.P, INS_NAVIGATION_P * INS_NAVIGATION_P);
        print_array("llh", n.llh, 2);
        printf("\"height\":%.17g}\n", n.llh[2]);
        usleep(PERIOD_US);
    }
    const ins_ros_value_t values[2] = {{"lost", "3"}, {"accepted", "12345"}};
    if (ins_ros_diagnose(ros, 1700000009000000001, INS_ROS_LEVEL_WARN, "samples are lost", values, 2) != INS_DDS_OK)
    {
        return fail("diagnose");
    }
    fflush(stdout);
    while (getchar() != EOF)
    {
    }
    ins_ros_close(ros);
    return 0;
}
