(** * aliased-extinction: Extinction whose period divides the steps of coarse ladders

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 - cos (32 * PI * s).
Definition emission (s : R) : R :=
  1 + s - sin (32 * PI * s) / (32 * PI).
Definition exact_depth (lambda : R) : R :=
  lambda - sin (32 * PI * lambda) / (32 * PI).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + lambda - sin (32 * PI * lambda) / (32 * PI)) * exp (- (lambda - sin (32 * PI * lambda) / (32 * PI))).

Theorem aliased_extinction (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
